// format/medit: MEDIT, text and binary, as rows of the table of formats. Depends on file_format.h.
#pragma once

#include <memory>

#include "file_format.h"

namespace tetstream {

Input openMedit(std::unique_ptr<ByteSource> bytes, const ReadOptions& options);
std::unique_ptr<Sink> createMesh(std::unique_ptr<ByteSink> bytes, const WriteOptions& options);
std::unique_ptr<Sink> createMeshb(std::unique_ptr<ByteSink> bytes, const WriteOptions& options);

// Whether the binary mesh and its solution may be longer than places of 32 bits can tell, those of
// the versions 1 and 2.
bool meditNeedsWidePlaces(const Schema& schema, uint64_t points, uint64_t cells, uint64_t faces);

}  // namespace tetstream
