// format/gmsh: what .msh files of ours say in $Comments, which other readers pass over: the types
// and names that the format cannot hold. Depends on schema.h.
//
//   tetstream position float32
//   tetstream physical NAME       the cell data that the groups of volumes hold; no name: none
//   tetstream geometrical NAME    the same for the entities
//   tetstream zero GROUP          the group of the cells whose label is 0
//   tetstream field int32 NAME    the type of a $NodeData
//   tetstream cells float32 NAME  the type of an $ElementData
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "schema.h"

namespace tetstream {

// Names of cell data, as others call them, too.
constexpr const char* kMshPhysical = "gmsh:physical";
constexpr const char* kMshEntity = "gmsh:geometrical";

struct MshHints {
  ScalarType position_type = ScalarType::kFloat64;
  std::string physical = kMshPhysical, entity = kMshEntity;
  bool labels_named = false;  // so they are there, even if all of them are 0
  int64_t zero_group = 0;     // of volumes, whose label is 0; 0: none
  std::map<std::string, ScalarType> fields, cell_data;
};

// A line; what is not ours says nothing.
void readMshHint(std::string_view line, MshHints* hints);
const char* mshTypeName(ScalarType type);

}  // namespace tetstream
