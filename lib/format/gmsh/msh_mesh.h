// format/gmsh: the mesh of a Gmsh file while it is read: what the sections of all versions share.
// Depends on mesh_intake.h, number_scan.h, tag_table.h.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mesh_intake.h"
#include "msh_hints.h"
#include "msh_kinds.h"
#include "number_scan.h"
#include "tag_table.h"

namespace tetstream {

constexpr size_t kMshInt = 4, kMshDouble = 8;  // bytes, in binary

struct MshMesh {
  MshMesh(FileScan& scan, const ReadOptions& read_options)
      : file(scan),
        numbers(scan),
        options(read_options),
        points(std::make_shared<TagTable>(read_options.temp_dir)),
        cells(read_options.temp_dir) {}

  FileScan& file;
  NumberScan numbers;
  const ReadOptions& options;
  bool version_4 = false;  // 4.1, or 4.0
  bool is_4_0 = false;
  size_t size_bytes = 8;  // of a count in version 4
  MshHints hints;
  std::unique_ptr<MeshIntake> intake;                    // from the nodes on
  std::shared_ptr<TagTable> points;                      // by Gmsh's tags, as ranks
  TagTable cells;                                        // the same; see finishCells
  std::map<std::pair<int, int64_t>, std::string> names;  // of physical groups, by dimension and tag
  // An entity of version 4: its group, and what it is labelled with, which is its tag; of a part of
  // a partitioned one the tag of that.
  struct Entity {
    int64_t group, label;
    bool is_between_parts;  // where nothing is but that the mesh was divided there
  };
  std::map<std::pair<int, int64_t>, Entity> entities;  // by dimension and tag
  uint64_t node_rows = 0, element_rows = 0;            // of the sections
  // By dimension and tag, those that entities or elements are in beside their first.
  std::set<std::pair<int, int64_t>> further_groups;
  // What labels faces: physical groups, if there is a face of one; others have no label then.
  enum class FaceLabels { kEntities, kGroups } face_labels = FaceLabels::kEntities;

  void checkTag(int64_t tag) const;  // of a node or an element
  // That a physical group stands for.
  int64_t labelOf(int dimension, int64_t group) const {
    const auto label = dimension == 3 ? hints.label_of.find(group) : hints.label_of.end();
    return label == hints.label_of.end() ? group : label->second;
  }
  // A cell or a face, by its nodes' tags.
  void addCell(CellKind kind, const int64_t* nodes, int64_t tag, int64_t group, int64_t entity);
  void beginNodes();
  void endNodes();
  // The tags of the elements that came so far can be looked for.
  void finishCells();

  // msh_placed.cpp: what is read where it lies. Each passes over rows that can be, or returns false
  // with nothing taken: they are to be added.
  bool placeNodes2(uint64_t count);
  bool passTags4(uint64_t count, uint64_t first);  // of nodes, the first one's rank
  bool placePositions4(uint64_t count, size_t reals_of_row);
  // Elements of integers of that width: their tag, some others, the nodes. In version 4 all have
  // the group and the entity; else those are the first two of the others.
  struct Elements {
    CellKind kind;
    uint64_t count;
    size_t width, others;
    int64_t group, entity;
  };
  bool placeElements(const Elements& elements);
  // Values of all nodes, or of all cells, in their order.
  bool placeData(size_t data, bool of_cells, uint64_t rows, size_t components);

 private:
  struct PlacedElements {
    RowsPlace rows;
    size_t width;
    uint64_t first;  // rank of the first cell
  };
  // The last cell or face, for those that are the same in another group.
  struct LastElement {
    CellShape shape = CellShape::kPoint;  // none yet
    int64_t corners[kMostCorners] = {};
    int64_t group = 0, entity = 0;
    int64_t first = 0, count = 0;  // ranks of its cells
  };
  bool isLastInAnotherGroup(CellShape shape, const int64_t* corners, int64_t group,
                            int64_t entity) const;
  void addFace(CellKind kind, const int64_t* corners, int64_t group, int64_t entity);
  void addTags(TagTable& table, const RowsPlace& rows, size_t width, uint64_t first);
  void placeLabels(const Elements& elements, const RowsPlace& rows);
  void addPlacedTags();  // which only data ask for

  LastElement last_;
  std::vector<PlacedElements> placed_;
};

std::string notThere(int64_t element, int64_t node);

// msh_2.cpp, which has those of format 1, too, and msh_4.cpp: the bodies of sections, up to their
// $End; how many rows nodes or elements have, with which these begin.
void readNode(MshMesh& mesh, uint64_t rank);  // its tag and its position
void readNodes2(MshMesh& mesh);
void readParametricNodes2(MshMesh& mesh);
void readElements1(MshMesh& mesh);
void readElements2(MshMesh& mesh);
void readEntities4(MshMesh& mesh, bool partitioned);
void readNodes4(MshMesh& mesh);
void readElements4(MshMesh& mesh);
uint64_t readRowCount4(MshMesh& mesh);

// msh_data.cpp: $NodeData, $ElementData. Blocks of one name and time step are one column.
class MshData {
 public:
  void read(MshMesh& mesh, bool of_cells);
  // Of all of them; none if they differ. Who knows none writes 0.
  std::optional<double> time() const;

 private:
  struct Block {
    std::string name, column;
    int64_t step;
    bool of_cells;
    int components;
    size_t data;  // of the intake
  };
  size_t dataFor(MshMesh& mesh, const std::string& name, int64_t step, bool of_cells,
                 int components);

  std::vector<Block> blocks_;
  std::vector<double> times_;
};

}  // namespace tetstream
