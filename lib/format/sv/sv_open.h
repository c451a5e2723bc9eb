// format/sv: what the readers of .sva and .svb share once the header is read: which form the file
// has, and the stream that its elements make. Depends on sv_block.h, sv_bytes.h, file_format.h.
#pragma once

#include <memory>

#include "file_format.h"
#include "sv_block.h"
#include "sv_bytes.h"

namespace tetstream {

enum class SvForm {
  kUndecided,
  kPreOrder,   // the first element is a vertex: vertices come before their cells
  kPostOrder,  // the first element is a cell: a vertex comes after its last cell
  kIndexed,    // all vertices, then all cells, and nothing finalized: no stream
};

// Looks at the body's bytes just far enough to know its form.
class SvScanner {
 public:
  virtual ~SvScanner() = default;
  virtual SvForm feed(const unsigned char* data, size_t size) = 0;
  virtual SvForm end() = 0;  // never kUndecided
};

// `bytes` stands at the body and stays there. A file is scanned up to where its form shows; of a
// pipe the first megabyte, and what does not show its form there is spooled.
SvForm findSvForm(SvBytes& bytes, SvScanner& scanner, const std::string& temp_dir);

// The elements as a stream, checked.
std::unique_ptr<Source> makeSvStream(SvForm form, std::unique_ptr<SvElements> elements);
std::unique_ptr<Source> makeSvPostOrder(std::unique_ptr<SvElements> elements);

// Compares what was read with the header's counts, throws kBadData at a difference. An empty body
// is an error unless the header announces it: else a truncated file would be an empty mesh.
void checkSvCounts(const SvElements& elements, int64_t vertex_count, int64_t cell_count);

// Throws kBadData, naming the element, if a position in the block is not finite.
void checkSvPositions(const SvElements& elements, SvBlock& block);
// Index of the first value that is not finite, or `count`.
size_t firstNotFinite(const void* values, ScalarType type, size_t count);

}  // namespace tetstream
