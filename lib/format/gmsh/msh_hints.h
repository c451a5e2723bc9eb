// format/gmsh: what .msh files of ours say in $Comments, which other readers pass over: the types
// and names that the format cannot hold. Depends on schema.h.
//
//   tetstream position float32
//   tetstream physical NAME       the cell data that the groups of volumes hold; no name: none
//   tetstream geometrical NAME    the same for the entities
//   tetstream group GROUP LABEL   cells in it have this label, which is no group's number
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
  bool labels_named = false;            // so they are there, even if all of them are 0
  std::map<int64_t, int64_t> label_of;  // by the group of volumes, where that is another one
  std::map<std::string, ScalarType> fields, cell_data;
};

// A line; what is not ours says nothing.
void readMshHint(std::string_view line, MshHints* hints);
const char* mshTypeName(ScalarType type);

}  // namespace tetstream
