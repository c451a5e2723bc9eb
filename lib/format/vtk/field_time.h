// format/vtk: the time of the values, among what VTK's files call field data: arrays that belong to
// no vertex or cell.
#pragma once

#include <string_view>

namespace tetstream {

constexpr const char* kVtkTime = "TimeValue";  // as VTK and ParaView write it

// Of an array of one number. TIME is VisIt's name.
inline bool isVtkTime(std::string_view name) {
  return name == kVtkTime || name == "TIME";
}

}  // namespace tetstream
