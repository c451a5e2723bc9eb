// format/sv: the elements of a streaming mesh file (.sva, .svb), some thousands at a time, as they
// stand in the file. Readers parse into it, writers print from it. Depends on batch.h.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "batch.h"

namespace tetstream {

constexpr size_t kSvBlockElements = 4096;  // a multiple of the 32 elements of an .svb block

enum class SvKind : uint8_t { kVertex, kCell, kFinalize };

struct SvBlock {
  explicit SvBlock(const Schema& schema) : rows(schema) {}
  void clear(uint64_t first_vertex) {
    rows.clear(first_vertex);
    kinds.clear();
    places.clear();
    finalized.clear();
  }

  Batch rows;                      // the vertices and the cells; corners are references of the file
  std::vector<SvKind> kinds;       // of the elements, in order
  std::vector<uint64_t> places;    // read: line or byte of each element
  std::vector<int64_t> finalized;  // the reference of each explicit finalization
};

// The elements of a file in order, parsed but not checked against each other.
class SvElements {
 public:
  virtual ~SvElements() = default;
  virtual const Schema& schema() const = 0;  // counts: what the header says
  // Adds the next elements to the cleared block: kSvBlockElements or less; an explicit finalization
  // is followed only by others. The cut depends on the file alone. False: there are none left.
  virtual bool read(SvBlock& block) = 0;
  // "mesh.sva: line 12" for an entry of `places`.
  virtual std::string where(uint64_t place) const = 0;
  // "mesh.sva: the file's end".
  virtual std::string whereEnd() const = 0;
};

// Prints elements. begin is called once, first, when there is an element or at the end.
class SvEncoder {
 public:
  virtual ~SvEncoder() = default;
  virtual void begin(const Schema& schema) = 0;
  virtual void write(SvBlock& block) = 0;
  virtual void finish(int64_t vertex_count, int64_t cell_count) = 0;
};

}  // namespace tetstream
