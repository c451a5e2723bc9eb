// format/medit: MEDIT, text and binary, as rows of the table of formats. Depends on file_format.h.
#pragma once

#include <memory>

#include "file_format.h"

namespace tetstream {

Input openMedit(std::unique_ptr<ByteSource> bytes, const ReadOptions& options);
std::unique_ptr<Sink> createMesh(std::unique_ptr<ByteSink> bytes, const WriteOptions& options);
std::unique_ptr<Sink> createMeshb(std::unique_ptr<ByteSink> bytes, const WriteOptions& options);

}  // namespace tetstream
