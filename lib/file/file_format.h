// file: what a format of files is: the options of its reader and its writer, and the row that it
// has in the table of formats. Depends on stream, base.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "byte_watch.h"
#include "bytes.h"
#include "source.h"
#include "text_pieces.h"

namespace tetstream {

constexpr int64_t kLastStep = -1;

// Where points at the same place become one.
enum class PointJoining : uint8_t {
  kAuto,  // everywhere in a mesh of which no two cells share a point; else as kNo
  kYes,   // everywhere
  kNo     // only where pieces of a parallel run meet
};

struct ReadOptions {
  std::string temp_dir;                          // for spools; empty: $TMPDIR or /tmp
  std::function<void(const std::string&)> note;  // what was left out or assumed; may be empty
  std::string path;  // of a file; empty: the bytes come from elsewhere, nothing lies beside them
  bool recover = false;  // .tets: what is whole of a file that is damaged or cut off
  bool split = false;    // hexahedra, prisms and pyramids into tetrahedra; else they are errors
  PointJoining join = PointJoining::kAuto;
  int64_t step = kLastStep;          // which of the time steps, from 0, of a file that has several
  TextThreads threads;               // who helps the thread that opens
  const ByteWatch* watch = nullptr;  // of opening; may be null

  // For files that are opened besides.
  std::unique_ptr<ByteSource> watched(std::unique_ptr<ByteSource> bytes) const {
    return watch ? watch->watched(std::move(bytes)) : std::move(bytes);
  }
};

struct WriteOptions {
  std::string temp_dir;
  std::function<void(const std::string&)> note;
  std::string path;             // as for reading
  JointFiles* joint = nullptr;  // gives files beside the output their names together with it; null:
                                // they get them at once
  std::function<void()> tell;   // while a file is completed; may be empty
  bool is_mapped = false;       // a map of vertices names cells by their rank in the stream
  bool compress = true;         // .tets: zstd where built in; .vtu: zlib
  bool binary = true;           // .msh: else text
  bool newest = true;           // .msh: 4.1, else 2.2
  bool post_order = false;      // .sva, .svb

  // Where nothing is written for long. What `tell` throws leaves it.
  void tellOfWriting() const {
    if (tell) tell();
  }
};

struct Format {
  const char* name;           // "tets", the word of --format
  const char* extensions;     // ".tets", blank-separated
  const char* text;           // one line
  bool float32_only = false;  // positions and fields are rounded, before they are checked
  bool label_names = false;   // are held
  bool time = false;          // is held
  bool reads_pipes = false;   // as they come; else they are spooled
  bool recovers = false;      // what is whole of a damaged file can be read
  // Null where the format is not read or not written.
  Input (*open)(std::unique_ptr<ByteSource> bytes, const ReadOptions& options) = nullptr;
  std::unique_ptr<Sink> (*create)(std::unique_ptr<ByteSink> bytes,
                                  const WriteOptions& options) = nullptr;
};

}  // namespace tetstream
