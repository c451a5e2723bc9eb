// format/gmsh: how the labels of cells and faces become Gmsh's entities and physical groups.
// Depends on mesh_spool.h, msh_hints.h, file_format.h.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "file_format.h"
#include "label_column.h"
#include "mesh_spool.h"
#include "msh_hints.h"
#include "rows_at_once.h"

namespace tetstream {

// A volume: its tag, which in version 4.1 differs from the others', its group, 0 for none, its
// cells, and how many volumes were met before it.
struct MshVolume {
  int32_t tag, group;
  uint64_t cells;
  int64_t rank;
};

class MshLabels {
 public:
  // The arguments have to outlive this.
  MshLabels(MeshSpool& mesh, const WriteOptions& options);

  // Cell arrays that have become groups and entities; none: there is no such array.
  const std::optional<size_t>& groups() const { return group_column_; }
  const std::optional<size_t>& entities() const { return entity_column_; }
  bool isLabel(size_t column) const { return column == group_column_ || column == entity_column_; }
  const std::map<std::pair<int64_t, int64_t>, MshVolume>& volumes() const { return volumes_; }
  // The groups of the cells whose labels are no groups' numbers.
  const std::map<int64_t, int32_t>& groupsOfOthers() const { return groups_of_others_; }
  // That of the cells with a label; 0: none.
  int32_t groupOf(int64_t label) const;
  // Volumes that have another tag than their cells' entities.
  uint64_t renumbered() const { return renumbered_; }
  // Whether the cells of each volume follow each other.
  bool cellsAreTogether() const { return are_together_; }
  // How many faces each has, by label, which is its tag and its group.
  const std::map<int64_t, uint64_t>& surfaces() const { return surfaces_; }
  uint64_t facesLeftOut() const { return faces_left_out_; }
  uint64_t faces() const { return faces_; }
  static bool isGroup(int64_t label) { return label > 0 && label <= INT32_MAX; }

  // Visits the volume of each cell, in order: visit(cell, volume). Some of the time it tells that
  // the file is being written, which may throw.
  template <class Visit>
  void forEachCell(Visit visit) {
    int64_t groups[kRowsAtOnce] = {}, entities[kRowsAtOnce] = {};
    for (uint64_t first = 0; first < mesh_.cellCount(); first += kRowsAtOnce) {
      const uint64_t left = mesh_.cellCount() - first;
      const size_t n = left < kRowsAtOnce ? static_cast<size_t>(left) : kRowsAtOnce;
      options_.tellOfWriting();
      read(group_column_, first, n, groups);
      read(entity_column_, first, n, entities);
      for (size_t i = 0; i < n; ++i)
        visit(first + i, volumes_.find({groups[i], entities[i]})->second);
    }
  }

 private:
  void read(const std::optional<size_t>& column, uint64_t first, size_t count, int64_t* out);
  void chooseColumns();
  int64_t findVolumes();
  void chooseTags(int64_t highest);
  void groupOthers();
  void findSurfaces();

  MeshSpool& mesh_;
  const WriteOptions& options_;
  std::optional<size_t> group_column_, entity_column_;
  std::map<std::pair<int64_t, int64_t>, MshVolume> volumes_;
  bool are_together_ = true;
  std::map<int64_t, int32_t> groups_of_others_;
  uint64_t renumbered_ = 0;
  std::map<int64_t, uint64_t> surfaces_;
  uint64_t faces_ = 0, faces_left_out_ = 0;
};

}  // namespace tetstream
