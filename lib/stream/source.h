// stream: where events come from and where they go. Depends on batch.h.
//
// Pull on the left, push on the right: whoever needs data asks a Source; whoever has data hands it
// to a Sink. All of them throw Error; messages of sources name the place in the input.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "batch.h"
#include "waiting.h"

namespace tetstream {

constexpr size_t kBatchCells = 4096;  // what our own sources put into a batch, about

// What a reading is for. kPositions: the places of the vertices alone, in any order; fields, cells
// and whatever else there is may be left out, and what is wrong with it is not found.
enum class Part : uint8_t { kAll, kPositions };

class Source;

// A part of a stream that is read beside the others of it. Events of the part before may come first
// again.
struct Stretch {
  struct Begin {
    uint64_t vertex = 0, cell = 0;  // the first of its own
    uint64_t first_cell = 0;        // that comes
  };
  std::unique_ptr<Source> source;
  Begin begin;
};

// A mesh as a stream of events.
class Source {
 public:
  virtual ~Source() = default;
  virtual const Schema& schema() const = 0;
  // Fills the view with the next events and returns true, or returns false at the end of the
  // stream (and again at every later call). The arrays live until the next call.
  virtual bool next(BatchView& batch) = 0;
  // Another reading of the same stream, from its first event on, while this one has not begun and
  // as long as it lives; null where the input cannot be read twice.
  virtual std::unique_ptr<Source> again(Part) { return nullptr; }
  // The same in `most` parts or fewer, in their order, each for a thread of its own and about as
  // long to be read. Where there are cells, the vertices of `before` ranks come again before a
  // part's own ones. Empty where the stream can only be read from end to end, or has too little.
  virtual std::vector<Stretch> againInStretches(Part, size_t /* most */, uint64_t /* before */) {
    return {};
  }
};

// A mesh whose points and cells can be read by range, as often as wanted; sequential ranges are
// the fast ones. Its schema's counts are known. Nothing is said about order.
class IndexedSource {
 public:
  virtual ~IndexedSource() = default;
  virtual const Schema& schema() const = 0;
  // Whether single rows in any order are as cheap as sequential ones.
  virtual bool randomAccess() const { return false; }
  // Per point, non-zero: never moved, as a point, or as one of an edge or a face that is locked;
  // null where there are none.
  virtual const uint8_t* locked() const { return nullptr; }
  // Of the first point, cell and face, in messages.
  virtual uint64_t firstNumber() const { return 0; }
  // Of a labelled face, in messages.
  virtual int64_t faceNumber(uint64_t row) { return static_cast<int64_t>(firstNumber() + row); }
  // Whether the points have come out of another order; then readOrigins tells their ranks there.
  virtual bool hasOrigins() const { return false; }
  // Rows [first, first + count) into `out`, laid out as in BatchView.
  virtual void readPositions(uint64_t first, size_t count, void* out) = 0;
  virtual void readField(size_t column, uint64_t first, size_t count, void* out) = 0;
  virtual void readCells(uint64_t first, size_t count, int64_t* out) = 0;
  virtual void readCellData(size_t column, uint64_t first, size_t count, void* out) = 0;
  // Labelled faces, of which the schema knows the number: three points each.
  virtual void readFaces(uint64_t, size_t, int64_t* /* corners */, int64_t* /* labels */) {}
  virtual void readOrigins(uint64_t first, size_t count, int64_t* out) {
    for (size_t i = 0; i < count; ++i) out[i] = static_cast<int64_t>(first + i);
  }
};

// What a reader opens: exactly one of the two.
struct Input {
  std::unique_ptr<Source> stream;
  std::unique_ptr<IndexedSource> indexed;
  // Callbacks of the caller's: a stream that is read by the caller's thread alone.
  bool stays_with_caller = true;
  // Where reading may wait for somebody at the other end: no thread reads it that others wait for,
  // and it is ended when that has been read, so it is for a stream that is not read again.
  std::shared_ptr<Waiting> waiting = {};
  std::string name = {};   // of the file that it is read from; empty: of none
  bool has_steps = false;  // of time, of which one was chosen
  const Schema& schema() const { return stream ? stream->schema() : indexed->schema(); }
};

// Takes a stream of events: begin, put any number of times, finish. A sink that is destroyed
// without finish (after an error) leaves nothing under its final name.
class Sink {
 public:
  virtual ~Sink() = default;
  // The schema's `known beforehand` part describes the stream that is to come, where known.
  virtual void begin(const Schema& schema) = 0;
  virtual void put(const BatchView& batch) = 0;
  virtual void finish() = 0;
  // Callbacks of the caller's, or what may wait for somebody at the other end: to be called by the
  // caller's thread alone.
  virtual bool staysWithCaller() const { return true; }
};

// Joins both ends without anything in between.
void copyStream(Source& source, Sink& sink);

}  // namespace tetstream
