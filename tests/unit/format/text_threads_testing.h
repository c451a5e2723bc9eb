// Shared by the tests of text that several threads read: the same mesh, and of what is wrong the
// same sentence, for any number of threads and wherever the text is cut.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <span>

#include "indexed_testing.h"
#include "slow_run.h"
#include "strange_workers.h"
#include "tasks.h"

namespace tetstream::test {

constexpr int kPoints = 60, kCells = 70;

// ------------------------------------------------------------------------ texts of all formats

// Numbers in many ways; a comment where the format has them.
class Words {
 public:
  std::string real() {
    const double value = std::uniform_real_distribution<>(-9, 9)(random_);
    const char* const forms[] = {"%.17g", "%.3f", "%+.5e", "%.0f", "%12.4g"};
    return textOf(forms[random_() % std::size(forms)], value);
  }
  std::string reals(int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += real() + " ";
    return text;
  }
  // Four points of a cell, from `first` on.
  std::string corners(int first, int count) {
    std::string text;
    for (int i = 0, at = static_cast<int>(random_() % (kPoints - 20)); i < count; ++i)
      text += std::to_string(first + (at += 1 + static_cast<int>(random_() % 4))) + " ";
    return text;
  }
  std::string label() { return std::to_string(random_() % 3); }

 private:
  std::mt19937_64 random_{5};
};

// ------------------------------------------------------------------------- what comes of a text

template <class Read>
inline void appendRows(std::string& out, size_t row_bytes, int64_t rows, Read read) {
  std::string held(row_bytes * static_cast<size_t>(rows), '\0');
  if (rows > 0) read(static_cast<size_t>(rows), held.data());
  out += held;
}

inline std::string bytesOfMesh(IndexedSource& mesh) {
  const Schema& schema = mesh.schema();
  std::string all;
  appendRows(all, 3 * sizeOf(schema.position_type), schema.vertex_count,
             [&](size_t n, void* to) { mesh.readPositions(0, n, to); });
  for (size_t k = 0; k < schema.fields.size(); ++k) {
    all += schema.fields[k].name;
    appendRows(all, schema.fields[k].bytesPerRow(), schema.vertex_count,
               [&](size_t n, void* to) { mesh.readField(k, 0, n, to); });
  }
  appendRows(all, 4 * sizeof(int64_t), schema.cell_count,
             [&](size_t n, void* to) { mesh.readCells(0, n, static_cast<int64_t*>(to)); });
  for (size_t k = 0; k < schema.cell_data.size(); ++k) {
    all += schema.cell_data[k].name;
    appendRows(all, schema.cell_data[k].bytesPerRow(), schema.cell_count,
               [&](size_t n, void* to) { mesh.readCellData(k, 0, n, to); });
  }
  std::vector<int64_t> labels(static_cast<size_t>(std::max<int64_t>(schema.face_count, 0)));
  appendRows(all, 3 * sizeof(int64_t), schema.face_count, [&](size_t n, void* to) {
    mesh.readFaces(0, n, static_cast<int64_t*>(to), labels.data());
  });
  for (const int64_t label : labels) all += std::to_string(label) + " ";
  return all;
}

// The bytes of the mesh with the notes, or the sentence of the error.
using OpenIt = std::function<Input(const ReadOptions&)>;
inline std::string outcomeOf(const OpenIt& open, const TextThreads& threads = {}) {
  std::string notes;
  ReadOptions options;
  options.threads = threads;
  options.note = [&notes](const std::string& note) { notes += note + "\n"; };
  try {
    Input input = open(options);
    return bytesOfMesh(*input.indexed) + notes;
  } catch (const Error& error) {
    return "error: " + error.text();
  }
}

// Tasks of 3, 2 and 8 threads, which the tests share; a slow run has those of 3.
inline const std::vector<std::unique_ptr<const Tasks>>& someTasks() {
  static const auto tasks = [] {
    std::vector<std::unique_ptr<const Tasks>> all;
    const size_t threads[] = {3, 2, 8};
    for (size_t i = 0; i < std::size(threads); i += oneIn(3))
      all.push_back(std::make_unique<const Tasks>(threads[i]));
    return all;
  }();
  return tasks;
}

// Returns what one thread makes of it.
inline std::string expectSame(const OpenIt& open, std::initializer_list<size_t> piece_bytes) {
  const std::string alone = outcomeOf(open);
  for (const auto& tasks : someTasks())
    for (const size_t bytes : piece_bytes)
      EXPECT_TRUE(outcomeOf(open, {tasks.get(), bytes}) == alone)
          << tasks->threads() << " threads, pieces of " << bytes
          << " bytes: " << outcomeOf(open, {tasks.get(), bytes}).substr(0, 200)
          << "\nalone: " << alone.substr(0, 200);
  return alone;
}

inline OpenIt opening(Open open, const std::string& text) {
  return [=](const ReadOptions& options) { return openText(open, text, options); };
}

inline std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  for (size_t at = 0, end; at < text.size(); at = end + 1) {
    end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
  }
  return lines;
}

inline std::string joined(const std::vector<std::string>& lines, const std::string& end) {
  std::string text;
  for (const std::string& line : lines) text += line + end;
  return text;
}

// Strange things in a line: its error, with the line, is that of one thread.
inline const std::function<std::string(const std::string&)> kDamages[] = {
    [](const std::string& line) { return line.substr(0, line.find_last_of(' ', line.size() - 2)); },
    [](const std::string& line) { return "x" + line; },
    [](const std::string& line) { return line + "1.5D+01 +2 -3"; },
    [](const std::string& line) { return "99999999999999999999 " + line; },
    [](const std::string& line) { return "400 " + line; },
    [](const std::string& line) { return std::string("0\0 ", 3) + line; },
    [](const std::string& line) { return "nan nan nan " + line; },
    [](const std::string& line) { return std::string(1500, '7') + " " + line; },
    [](const std::string&) { return std::string(); },
};

// A text of some format.
struct TextFormat {
  const char* name;
  Open open;
  std::string text;
  char comment = 0;  // where one begins; 0: the format has none
  OpenIt opening() const { return test::opening(open, text); }
};

inline void expectSameWhereverCutOff(std::span<const TextFormat> formats) {
  for (const TextFormat& format : formats) {
    SCOPED_TRACE(format.name);
    for (size_t size = 61; size < format.text.size(); size += 211)
      expectSame(opening(format.open, format.text.substr(0, size)), {50});
  }
}

inline void expectSameWhoeverComes(std::span<const TextFormat> formats) {
  NoWorkers none;
  HastyWorkers hasty;
  LazyWorkers lazy;
  for (const TextFormat& format : formats) {
    const OpenIt open = format.opening();
    const std::string mesh = outcomeOf(open);
    for (Workers* workers : std::initializer_list<Workers*>{&none, &hasty, &lazy}) {
      const Tasks tasks(4, workers);
      EXPECT_TRUE(outcomeOf(open, {&tasks, 50}) == mesh) << format.name;
    }
  }
  EXPECT_GT(none.refused, 0U);
  EXPECT_GT(lazy.waiting.size(), 0U);
  lazy.workAll();  // too late
}

}  // namespace tetstream::test
