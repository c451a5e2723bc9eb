// base: where a path that is to be written leads.
#pragma once

#include <string>

namespace tetstream {

struct FinalPlace {
  // The file that the name is of, or would be of: links are followed, also where nothing is there.
  std::string path;
  // Of this process, where the path is a name of it, such as /dev/stdout or /dev/fd/3; or -1.
  int descriptor = -1;
};

FinalPlace finalPlaceOf(const std::string& path);

}  // namespace tetstream
