#include "held_names.h"

#include <set>

namespace tetstream {

void tellOfName(const std::string& name, const std::string& held, const Tell& tell) {
  if (held != name)
    tell("the name of \"" + name + "\" has characters that the format cannot hold: it is \"" +
         held + "\"");
}

std::vector<std::string> heldNames(const std::vector<Column>& columns, const HoldName& hold,
                                   const Tell& tell) {
  std::vector<std::string> held(columns.size());
  std::set<std::string> taken;
  for (const bool stays : {true, false})
    for (size_t i = 0; i < columns.size(); ++i) {
      std::string name = hold(columns[i].name);
      if ((name == columns[i].name) != stays) continue;
      while (!taken.insert(name).second) name += '_';
      held[i] = name;
    }
  for (size_t i = 0; i < columns.size(); ++i) tellOfName(columns[i].name, held[i], tell);
  return held;
}

}  // namespace tetstream
