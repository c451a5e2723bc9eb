// format/tets: tetstream's own stream, as rows of the table of formats. Depends on file_format.h.
#pragma once

#include <memory>

#include "file_format.h"

namespace tetstream {

Input openTets(std::unique_ptr<ByteSource> bytes, const ReadOptions& options);
std::unique_ptr<Sink> createTets(std::unique_ptr<ByteSink> bytes, const WriteOptions& options);

}  // namespace tetstream
