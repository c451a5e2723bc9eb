// layout: a mesh that comes in batches, as an indexed one in temporary files. Depends on
// mesh_reading.h, mesh_spool.h.
#pragma once

#include "mesh_reading.h"
#include "mesh_spool.h"

namespace tetstream {

// Finalizations are dropped: an indexed mesh has none. Locked edges and faces lock their vertices.
// Vertices and faces keep the numbers that they had in the input.
class SpooledMesh : public IndexedSource {
 public:
  SpooledMesh(const Schema& schema, const std::string& temp_dir);
  void put(const BatchView& batch);
  void finish();  // before it is read

  const Schema& schema() const override { return mesh_.schema(); }
  const uint8_t* locked() const override { return mesh_.locked(); }
  int64_t faceNumber(uint64_t row) override;
  bool hasOrigins() const override { return origins_.rows() > 0; }
  void readPositions(uint64_t first, size_t count, void* out) override {
    mesh_.readPositions(first, count, out);
  }
  void readField(size_t column, uint64_t first, size_t count, void* out) override {
    mesh_.readField(column, first, count, out);
  }
  void readCells(uint64_t first, size_t count, int64_t* out) override {
    mesh_.readCells(first, count, out);
  }
  void readCellData(size_t column, uint64_t first, size_t count, void* out) override {
    mesh_.readCellData(column, first, count, out);
  }
  void readFaces(uint64_t first, size_t count, int64_t* corners, int64_t* labels) override {
    mesh_.readFaces(first, count, corners, labels);
  }
  void readOrigins(uint64_t first, size_t count, int64_t* out) override;

  uint64_t diskBytes() const;

 private:
  void lock(const BatchView& batch);
  void lock(const char* what, uint64_t row, const int64_t* vertices, size_t count);

  MeshSpool mesh_;
  RowSpool origins_, face_numbers_;  // of a stream that has them
  uint64_t edges_read_ = 0;
};

// All of a stream.
std::unique_ptr<SpooledMesh> spoolStream(Source& source, const std::string& temp_dir,
                                         const Tell& tell);

}  // namespace tetstream
