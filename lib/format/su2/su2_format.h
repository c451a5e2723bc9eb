// format/su2: SU2, as rows of the table of formats. Depends on file_format.h.
#pragma once

#include <memory>

#include "file_format.h"

namespace tetstream {

Input openSu2(std::unique_ptr<ByteSource> bytes, const ReadOptions& options);

}  // namespace tetstream
