// tests/support: a .vtu file, or another one of an indexed mesh, read whole, for tests that compare
// meshes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "registry.h"
#include "vector3.h"

namespace tetstream::test {

struct VtuMesh {
  Schema schema;
  std::string positions;  // bytes, as they are given out
  std::vector<int64_t> cells;
  std::vector<std::string> fields, cell_data;
  std::vector<int64_t> faces, face_labels;
  std::vector<std::string> notes;
  bool operator==(const VtuMesh& other) const;  // but for the notes
};

// Reads `step` rows at once.
VtuMesh readMesh(std::unique_ptr<ByteSource> bytes, const Format& format, size_t step = 1000,
                 ReadOptions options = {});
// `file` is the file's bytes, called "test.vtu".
VtuMesh readVtu(const std::string& file, size_t step = 1000, const ReadOptions& options = {});
// The same of any indexed format, called "test.FORMAT".
VtuMesh readAs(const char* format, const std::string& file, size_t step = 1000,
               const ReadOptions& options = {});

// The sentence of the failure that reading gives, after its status's name; "" if there is none.
std::string vtuFailure(const std::string& file);
std::string failureAs(const char* format, const std::string& file);

// The mesh, written by the format.
std::string writtenAs(const char* format, const VtuMesh& mesh, bool compress = true);
std::string writtenBy(Sink& sink, std::vector<unsigned char>& out, const VtuMesh& mesh);

template <class T>
std::vector<T> valuesAs(const std::string& bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  bytes.copy(reinterpret_cast<char*>(values.data()), values.size() * sizeof(T));
  return values;
}

// With its sign: of a cell of four numbers of `places`, three to each.
inline double signedVolume(const std::vector<double>& places, const int64_t* cell) {
  const double* p[4];
  for (size_t k = 0; k < 4; ++k) p[k] = &places[3 * static_cast<size_t>(cell[k])];
  return sixVolume(p[0], p[1], p[2], p[3]) / 6;
}

}  // namespace tetstream::test
