// format/xdmf: DataItems that stand for others of the file, as PETSc writes them. Depends on
// xdmf_text.h.
#pragma once

#include "xdmf_text.h"

namespace tetstream {

// Puts the items that are meant in the place of those that refer to them. Throws if one leads
// nowhere, to itself, or to anything but a DataItem of the domain, by its name.
void followXdmfReferences(XdmfFile& file, const XdmfText& text);

}  // namespace tetstream
