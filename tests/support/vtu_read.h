// tests/support: a .vtu file read whole, for tests that compare meshes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "registry.h"

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

// `file` is the file's bytes, called "test.vtu". Reads `step` rows at once.
VtuMesh readVtu(const std::string& file, size_t step = 1000);

// The sentence of the failure that reading gives, after its status's name; "" if there is none.
std::string vtuFailure(const std::string& file);

template <class T>
std::vector<T> valuesAs(const std::string& bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  bytes.copy(reinterpret_cast<char*>(values.data()), values.size() * sizeof(T));
  return values;
}

}  // namespace tetstream::test
