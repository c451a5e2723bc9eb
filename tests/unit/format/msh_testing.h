// A mesh as the bytes of a .msh file.
#pragma once

#include "gmsh_format.h"
#include "indexed_testing.h"

namespace tetstream::test {

inline Bytes write(const SvMesh& m, bool binary, bool newest,
                   std::vector<std::string>* notes = nullptr) {
  Bytes out;
  WriteOptions options;
  options.binary = binary;
  options.newest = newest;
  if (notes) options.note = [notes](const std::string& note) { notes->push_back(note); };
  putStream(m, *createMsh(createMemory(out), options), 3);
  return out;
}

}  // namespace tetstream::test
