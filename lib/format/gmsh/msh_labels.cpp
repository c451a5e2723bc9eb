#include "msh_labels.h"

#include <algorithm>
#include <set>
#include <vector>

#include "rows_at_once.h"

namespace tetstream {

namespace {

constexpr int32_t kGroupOfAll = 1;

bool isIntegerColumn(const Column& column) {
  return column.components == 1 && !isFloat(column.type);
}

}  // namespace

MshLabels::MshLabels(MeshSpool& mesh, const WriteOptions& options)
    : mesh_(mesh), options_(options) {
  chooseColumns();
  findSurfaces();
  int64_t highest = findVolumes();
  if (options.newest && entity_column_ && volumes_.size() > kMostGroups) {
    entity_column_.reset();
    highest = findVolumes();
  }
  chooseTags(highest);
  groupOthers();
}

void MshLabels::read(const std::optional<size_t>& column, uint64_t first, size_t count,
                     int64_t* out) {
  if (column) readLabels(mesh_, *column, first, count, out);
}

void MshLabels::chooseColumns() {
  const std::vector<Column>& columns = mesh_.schema().cell_data;
  const int entity = findColumn(columns, kMshEntity);
  if (entity >= 0 && isIntegerColumn(columns[static_cast<size_t>(entity)]) &&
      canBeGroups(mesh_, static_cast<size_t>(entity), 1, INT32_MAX))
    entity_column_ = static_cast<size_t>(entity);
  group_column_ = labelColumn(mesh_, kMshPhysical, [&](size_t column) {
    return static_cast<int>(column) != entity && canBeGroups(mesh_, column, INT64_MIN, INT64_MAX);
  });
}

// Returns the highest label.
int64_t MshLabels::findVolumes() {
  volumes_.clear();
  are_together_ = true;
  int64_t groups[kRowsAtOnce] = {}, entities[kRowsAtOnce] = {};
  int64_t highest = 0;
  MshVolume* last = nullptr;
  for (uint64_t first = 0; first < mesh_.cellCount(); first += kRowsAtOnce) {
    const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, mesh_.cellCount() - first));
    options_.tellOfWriting();
    read(group_column_, first, n, groups);
    read(entity_column_, first, n, entities);
    for (size_t i = 0; i < n; ++i) {
      const auto rank = static_cast<int64_t>(volumes_.size());
      const auto [found, is_new] =
          volumes_.try_emplace({groups[i], entities[i]}, MshVolume{0, groupOf(groups[i]), 0, rank});
      are_together_ = are_together_ && (is_new || &found->second == last);
      last = &found->second;
      ++last->cells;
      highest = std::max({highest, groups[i], entities[i]});
    }
  }
  return highest;
}

// A tag is the entity's, or the group's, where that is free or, in version 2.2, whoever has it;
// else one above all of them. Cells without labels beside faces with such are one group: of a file
// that has groups, Gmsh saves again what is in one only, and meshio does not read cells of none.
void MshLabels::chooseTags(int64_t highest) {
  std::set<int64_t> used;
  const auto take = [&](MshVolume& volume, int64_t tag) {
    if (isGroup(tag) && used.insert(tag).second) volume.tag = static_cast<int32_t>(tag);
  };
  for (auto& [key, volume] : volumes_) {
    const int64_t tag = entity_column_ ? key.second : key.first;
    take(volume, tag);
    if (!options_.newest && isGroup(tag)) volume.tag = static_cast<int32_t>(tag);
  }
  int64_t low = 1;
  for (auto& [key, volume] : volumes_) {
    while (volume.tag == 0) {
      if (highest < INT32_MAX)
        take(volume, ++highest);
      else
        take(volume, low++);
    }
    if (!group_column_ && !surfaces_.empty()) volume.group = kGroupOfAll;
    renumbered_ += entity_column_ && volume.tag != key.second;
  }
}

int32_t MshLabels::groupOf(int64_t label) const {
  const auto other = groups_of_others_.find(label);
  if (other != groups_of_others_.end()) return other->second;
  return isGroup(label) ? static_cast<int32_t>(label) : 0;
}

// Cells of a label that is no group's number have a group of their own, which no label has, not
// even one that has a name and no cell. Those of the label 0 have one in version 4.1, for the same
// sake, beside such with groups, or beside faces.
void MshLabels::groupOthers() {
  if (!group_column_) return;
  std::set<int64_t> used, others;
  for (const auto& [key, volume] : volumes_) (isGroup(key.first) ? used : others).insert(key.first);
  if (!options_.newest || (used.empty() && others.size() == 1 && surfaces_.empty()))
    others.erase(0);
  for (const LabelName& name : mesh_.schema().label_names)
    if (name.array == mesh_.schema().cell_data[*group_column_].name && isGroup(name.label))
      used.insert(name.label);
  int64_t group = 0;
  const int64_t above = used.empty() ? 0 : *used.rbegin();
  if (above <= INT32_MAX - static_cast<int64_t>(kMostGroups)) group = above;
  for (const int64_t label : others) {
    do ++group;
    while (used.count(group) > 0);
    groups_of_others_[label] = static_cast<int32_t>(group);
  }
  for (auto& [key, volume] : volumes_) volume.group = groupOf(key.first);
}

void MshLabels::findSurfaces() {
  std::vector<int64_t> corners(3 * kRowsAtOnce), labels(kRowsAtOnce);
  const auto count = mesh_.faceCount();
  for (uint64_t first = 0; first < count; first += kRowsAtOnce) {
    const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, count - first));
    mesh_.readFaces(first, n, corners.data(), labels.data());
    for (size_t i = 0; i < n; ++i) {
      const bool known =
          isGroup(labels[i]) && (surfaces_.size() < kMostGroups || surfaces_.count(labels[i]) > 0);
      if (known) ++surfaces_[labels[i]];
      ++(known ? faces_ : faces_left_out_);
    }
  }
}

}  // namespace tetstream
