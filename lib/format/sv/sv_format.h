// format/sv: streaming volume meshes, text and binary, as rows of the table of formats. Depends on
// file_format.h.
#pragma once

#include <memory>

#include "file_format.h"

namespace tetstream {

Input openSva(std::unique_ptr<ByteSource> bytes, const ReadOptions& options);
Input openSvb(std::unique_ptr<ByteSource> bytes, const ReadOptions& options);
std::unique_ptr<Sink> createSva(std::unique_ptr<ByteSink> bytes, const WriteOptions& options);
std::unique_ptr<Sink> createSvb(std::unique_ptr<ByteSink> bytes, const WriteOptions& options);

}  // namespace tetstream
