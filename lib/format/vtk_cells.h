// format: VTK's numbers of cell types. Depends on nothing.
#pragma once

namespace tetstream {

constexpr int kVtkTetra = 10, kVtkTriangle = 5;  // linear

}  // namespace tetstream
