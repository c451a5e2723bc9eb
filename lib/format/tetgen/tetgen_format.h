// format/tetgen: TetGen, as rows of the table of formats. Depends on file_format.h.
#pragma once

#include <memory>

#include "file_format.h"

namespace tetstream {

Input openTetgen(std::unique_ptr<ByteSource> bytes, const ReadOptions& options);

}  // namespace tetstream
