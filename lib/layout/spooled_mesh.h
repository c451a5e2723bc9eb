// layout: a mesh that comes in batches, as an indexed one in temporary files. Depends on
// mesh_reading.h, row_spool.h.
#pragma once

#include "memory.h"
#include "mesh_reading.h"
#include "row_spool.h"

namespace tetstream {

// Finalizations are dropped: an indexed mesh has none. Locked edges and faces lock their vertices.
// What is small stays in memory; of a large mesh only the locks do, a byte a vertex if there are
// any.
class SpooledMesh : public IndexedSource {
 public:
  SpooledMesh(const Schema& schema, const std::string& temp_dir);
  void put(const BatchView& batch);
  void finish();  // before it is read

  const Schema& schema() const override { return schema_; }
  const uint8_t* locked() const override { return any_locked_ ? locked_.data() : nullptr; }
  int64_t faceNumber(uint64_t row) override;
  bool hasOrigins() const override { return origins_ != nullptr; }
  void readPositions(uint64_t first, size_t count, void* out) override;
  void readField(size_t column, uint64_t first, size_t count, void* out) override;
  void readCells(uint64_t first, size_t count, int64_t* out) override;
  void readCellData(size_t column, uint64_t first, size_t count, void* out) override;
  void readFaces(uint64_t first, size_t count, int64_t* corners, int64_t* labels) override;
  void readOrigins(uint64_t first, size_t count, int64_t* out) override;

  uint64_t diskBytes() const;

 private:
  void takeVertices(const BatchView& batch);
  void takeFaces(const BatchView& batch);
  void lock(const BatchView& batch);
  void lock(const char* what, uint64_t row, const int64_t* vertices, size_t count);
  void makeRoomForLocks(size_t vertices);

  Schema schema_;
  std::string temp_dir_;
  Account account_;
  RowSpool positions_, cells_, faces_;  // of a face three vertices, label, number
  std::vector<std::unique_ptr<RowSpool>> fields_, cell_data_;
  std::unique_ptr<RowSpool> origins_;  // of a stream that has them
  Array<uint8_t> locked_;              // per vertex so far
  bool any_locked_ = false;
  uint64_t edges_read_ = 0;
};

// All of a stream.
std::unique_ptr<SpooledMesh> spoolStream(Source& source, const std::string& temp_dir,
                                         const Tell& tell);

}  // namespace tetstream
