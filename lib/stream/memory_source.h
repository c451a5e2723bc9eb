// stream: an indexed mesh in arrays of somebody else's. Depends on source.h.
#pragma once

#include <vector>

#include "memory.h"
#include "source.h"

namespace tetstream {

// The whole mesh is one batch, whose arrays must live as long as the source; its finalizations are
// not looked at. Vertex ids are checked when cells and faces are read, those of locked edges and
// faces at once.
class MemorySource : public IndexedSource {
 public:
  // How the ids are written.
  struct Ids {
    const int32_t* narrow_cells = nullptr;  // those of cells, in place of the mesh's
    int64_t first = 0;  // the id of the first vertex: from there rows count in messages, too
  };
  MemorySource(const Schema& schema, const BatchView& mesh, Ids ids);
  MemorySource(const Schema& schema, const BatchView& mesh) : MemorySource(schema, mesh, Ids()) {}
  const Schema& schema() const override { return schema_; }
  bool randomAccess() const override { return true; }
  const uint8_t* locked() const override { return mesh_.locked; }
  uint64_t firstNumber() const override { return static_cast<uint64_t>(ids_.first); }
  void readPositions(uint64_t first, size_t count, void* out) override;
  void readField(size_t column, uint64_t first, size_t count, void* out) override;
  void readCells(uint64_t first, size_t count, int64_t* out) override;
  void readCellData(size_t column, uint64_t first, size_t count, void* out) override;
  void readFaces(uint64_t first, size_t count, int64_t* corners, int64_t* labels) override;

 private:
  void lockVertices();
  void lock(const char* what, size_t row, const int64_t* vertices, size_t count);
  int64_t checked(const char* what, uint64_t row, int64_t vertex) const;
  Schema schema_;
  std::vector<const void*> fields_, cell_data_;
  BatchView mesh_;
  Account account_;
  Array<uint8_t> locked_;  // where edges or faces are locked
  Ids ids_;
};

}  // namespace tetstream
