// format/sv: the elements of an indexed file, spooled in binary so that they can be read by range.
// Depends on sv_block.h, sv_open.h.
#pragma once

#include <memory>

#include "file_format.h"
#include "sv_open.h"

namespace tetstream {

// Reads all elements: vertices first, then cells, references absolute. Throws kBadData as the
// streams do. Memory is bounded; temporary files take the rest.
std::unique_ptr<IndexedSource> spoolSvElements(SvElements& elements, const std::string& temp_dir);

}  // namespace tetstream
