// tests/support: a mesh that owns columns of any type, and ways to make a stream of it and to take
// a stream back into it.
#pragma once

#include <array>
#include <cstring>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "slow_run.h"
#include "source.h"

namespace tetstream::test {

// Rows of one column, as bytes.
struct Rows {
  std::vector<unsigned char> bytes;
  void append(const void* rows, size_t count, size_t row_bytes) {
    const auto* from = static_cast<const unsigned char*>(rows);
    if (count) bytes.insert(bytes.end(), from, from + count * row_bytes);
  }
};

struct TestMesh {
  Schema schema;
  Rows positions;
  std::vector<Rows> fields, cell_data;
  std::vector<int64_t> cells;
  std::vector<uint8_t> locked;  // empty: none

  size_t vertexCount() const { return positions.bytes.size() / (3 * sizeOf(schema.position_type)); }
  size_t cellCount() const { return cells.size() / 4; }
  // A value, whatever its type.
  double position(size_t vertex, int axis) const;
  double field(size_t column, size_t vertex, int component = 0) const;
  double cellValue(size_t column, size_t cell, int component = 0) const;
  int64_t fieldInteger(size_t column, size_t vertex) const;
  int64_t cellInteger(size_t column, size_t cell) const;
  void setPosition(size_t vertex, int axis, double value);
  void setField(size_t column, size_t vertex, double value, int component = 0);

  // Adds a column whose value at a row is function(row, component).
  using Function = std::function<double(size_t row, int component)>;
  void addField(const Column& column, const Function& function);
  void addCellData(const Column& column, const Function& function);
  void addIntegerField(const std::string& name, const std::function<int64_t(size_t)>& function);
  void addIntegerCellData(const std::string& name, const std::function<int64_t(size_t)>& function);

  BatchView view();  // all of it, nothing finalized; valid until the mesh changes

 private:
  std::vector<const void*> field_pointers_, cell_pointers_;
};

// A mesh of points and cells, without columns.
TestMesh makeMesh(ScalarType position_type, const std::vector<double>& positions,
                  const std::vector<int64_t>& cells);

// The same mesh with its vertices in the order of their first use; unused ones are left out unless
// `keep_unused` puts them last.
TestMesh inStreamOrder(const TestMesh& mesh, bool keep_unused = false);
// The same mesh with vertices and cells, and the corners of each cell evenly, in random order.
TestMesh shuffled(const TestMesh& mesh, uint64_t seed);

// How a mesh is cut into a stream.
struct Cut {
  size_t batch_cells = 4096;
  bool all_vertices_first = false;  // in one batch, before any cell
  bool explicit_final = false;      // by BatchView::finalized and not by last_uses
  bool empty_batches = false;       // one after each batch that is not
  bool say_counts = true, say_front = false, say_box = false;
};

// A mesh in stream order as a Source. Its batches are copies, poisoned when the next one is asked
// for, so that whoever keeps a pointer is found out.
class MeshStream final : public Source {
 public:
  MeshStream(const TestMesh& mesh, const Cut& cut);
  const Schema& schema() const override { return schema_; }
  bool next(BatchView& batch) override;

 private:
  void addVerticesUpTo(size_t end);
  void addCell(size_t cell);

  const TestMesh& mesh_;
  Cut cut_;
  Schema schema_;
  Batch batch_;
  std::vector<size_t> last_use_;
  size_t vertex_ = 0, cell_ = 0;
  bool gave_empty_ = true, started_ = false;
};

using Face = std::array<int64_t, 3>;  // rising

// Takes a stream and checks, as a strict consumer would, that it is one: ranks follow each other,
// references are to active vertices, a labelled face comes once and before its vertices' last uses
// are over. What is wrong with it is said in `problem`, "" if nothing is.
class Recorder final : public Sink {
 public:
  void begin(const Schema& schema) override;
  void put(const BatchView& batch) override;
  void finish() override;

  TestMesh mesh;
  std::map<Face, int64_t> faces;  // with their labels
  std::string problem;
  bool finished = false;
  size_t batches = 0;
  // Whether each vertex was finalized by the last cell that uses it, and vertices came in the order
  // of their first use, none without a use.
  bool exact_finalization = true, compact = true;
  std::vector<unsigned char> allBytes() const;  // of every column, for comparison

 private:
  void wrong(const std::string& what) {
    if (problem.empty()) problem = what;
  }
  void use(int64_t vertex);
  void takeFaces(const BatchView& batch);
  std::vector<int64_t> first_use_, last_use_, final_at_;  // cell numbers; -1: not yet
};

}  // namespace tetstream::test
