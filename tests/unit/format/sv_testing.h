// Shared by the tests of .sva and .svb: random streams, and reading a file back while checking that
// what comes is a valid stream.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "pipes.h"
#include "registry.h"
#include "slow_run.h"
#include "status.h"

namespace tetstream::test {

// A mesh and its stream. Columns are one vector per field or cell array, all values as double.
struct Event {
  char kind;     // 'v', 'c' or 'x'
  int64_t rank;  // of the vertex or the cell
};

using Cell = std::array<int64_t, 4>;

struct SvMesh {
  Schema schema;
  std::vector<double> positions;
  std::vector<std::vector<double>> fields, cell_data;
  std::vector<Cell> cells;
  std::vector<uint8_t> last_uses;
  std::vector<Event> events;
  std::vector<int64_t> final_at;  // number of cells read when the vertex became final; -1: never

  size_t vertexCount() const { return positions.size() / 3; }
};

inline void appendAsDoubles(const void* values, ScalarType type, size_t count,
                            std::vector<double>& out) {
  const size_t before = out.size();
  out.resize(before + count);
  if (count > 0) convertScalars(values, type, out.data() + before, ScalarType::kFloat64, count);
}

// Reads a stream, failing the test if it breaks the rules of batch.h.
inline SvMesh readStream(Source& source) {
  SvMesh m;
  m.schema = source.schema();
  m.fields.resize(m.schema.fields.size());
  m.cell_data.resize(m.schema.cell_data.size());
  BatchView b;
  while (source.next(b)) {
    EXPECT_EQ(b.first_vertex, m.vertexCount());
    EXPECT_GT(b.vertex_count + b.cell_count + b.finalized_count, 0u);
    appendAsDoubles(b.positions, m.schema.position_type, 3 * b.vertex_count, m.positions);
    m.final_at.resize(m.vertexCount(), -1);
    for (size_t c = 0; c < m.fields.size(); ++c)
      appendAsDoubles(b.fields[c], m.schema.fields[c].type,
                      b.vertex_count * static_cast<size_t>(m.schema.fields[c].components),
                      m.fields[c]);
    for (size_t c = 0; c < m.cell_data.size(); ++c)
      appendAsDoubles(b.cell_data[c], m.schema.cell_data[c].type,
                      b.cell_count * static_cast<size_t>(m.schema.cell_data[c].components),
                      m.cell_data[c]);
    const auto finalize = [&](int64_t v) {
      EXPECT_LT(static_cast<size_t>(v), m.vertexCount());
      EXPECT_EQ(m.final_at.at(static_cast<size_t>(v)), -1) << "vertex " << v << " is final twice";
      m.final_at.at(static_cast<size_t>(v)) = static_cast<int64_t>(m.cells.size());
    };
    for (size_t i = 0; i < b.cell_count; ++i) {
      m.cells.push_back(
          {b.cells[4 * i], b.cells[4 * i + 1], b.cells[4 * i + 2], b.cells[4 * i + 3]});
      m.last_uses.push_back(b.last_uses ? b.last_uses[i] : 0);
      for (int64_t v : m.cells.back())
        EXPECT_EQ(m.final_at.at(static_cast<size_t>(v)), -1) << "used after it was final";
      for (size_t j = 0; j < 4; ++j)
        if (m.last_uses.back() >> j & 1) finalize(m.cells.back()[j]);
    }
    for (size_t i = 0; i < b.finalized_count; ++i) finalize(b.finalized[i]);
  }
  EXPECT_FALSE(source.next(b)) << "the end is the end again";
  return m;
}

// Reads an indexed mesh in pieces of an odd size.
inline SvMesh readIndexed(IndexedSource& source, size_t step = 7) {
  SvMesh m;
  m.schema = source.schema();
  const size_t vertices = static_cast<size_t>(m.schema.vertex_count);
  const size_t cells = static_cast<size_t>(m.schema.cell_count);
  m.fields.resize(m.schema.fields.size());
  m.cell_data.resize(m.schema.cell_data.size());
  Bytes rows(step * 8 * 9);
  for (size_t first = 0; first < vertices; first += step) {
    const size_t count = std::min(step, vertices - first);
    source.readPositions(first, count, rows.data());
    appendAsDoubles(rows.data(), m.schema.position_type, 3 * count, m.positions);
    for (size_t c = 0; c < m.fields.size(); ++c) {
      source.readField(c, first, count, rows.data());
      appendAsDoubles(rows.data(), m.schema.fields[c].type,
                      count * static_cast<size_t>(m.schema.fields[c].components), m.fields[c]);
    }
  }
  for (size_t first = 0; first < cells; first += step) {
    const size_t count = std::min(step, cells - first);
    std::vector<int64_t> ids(4 * count);
    source.readCells(first, count, ids.data());
    for (size_t i = 0; i < count; ++i)
      m.cells.push_back({ids[4 * i], ids[4 * i + 1], ids[4 * i + 2], ids[4 * i + 3]});
    for (size_t c = 0; c < m.cell_data.size(); ++c) {
      source.readCellData(c, first, count, rows.data());
      appendAsDoubles(rows.data(), m.schema.cell_data[c].type,
                      count * static_cast<size_t>(m.schema.cell_data[c].components),
                      m.cell_data[c]);
    }
  }
  return m;
}

inline SvMesh readAll(Input& input) {
  EXPECT_NE(input.stream == nullptr, input.indexed == nullptr);
  return input.stream ? readStream(*input.stream) : readIndexed(*input.indexed);
}

using Open = Input (*)(std::unique_ptr<ByteSource>, const ReadOptions&);
using Create = std::unique_ptr<Sink> (*)(std::unique_ptr<ByteSink>, const WriteOptions&);

inline Input openBytes(Open open, const Bytes& data, std::vector<std::string>* notes = nullptr) {
  ReadOptions options;
  if (notes) options.note = [notes](const std::string& text) { notes->push_back(text); };
  return open(openMemory(data.data(), data.size(), "mesh"), options);
}

inline SvMesh readBytes(Open open, const Bytes& data, std::vector<std::string>* notes = nullptr) {
  Input input = openBytes(open, data, notes);
  return readAll(input);
}

inline SvMesh readPipe(Open open, const Bytes& data, size_t step) {
  Input input = open(std::make_unique<PipeSource>(data, step, "mesh"), ReadOptions());
  return readAll(input);
}

// The error of reading the file, or kOk and "".
inline Error errorOf(Open open, const Bytes& data) {
  try {
    readBytes(open, data);
  } catch (const Error& error) {
    return error;
  }
  return Error(Status::kOk, "");
}

inline Bytes bytesOf(const std::string& text) {
  return Bytes(text.begin(), text.end());
}

// A stream of `cells` random cells: vertices come and go, some explicitly, some are never used and
// some never final. Every column gets values that float32 holds unless it is float64.
inline SvMesh randomStream(const Schema& schema, int cells, unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&](size_t n) { return static_cast<size_t>(random() % n); };
  SvMesh m;
  m.schema = schema;
  m.fields.resize(schema.fields.size());
  m.cell_data.resize(schema.cell_data.size());
  const auto value = [&](ScalarType type) {
    const double x = (static_cast<double>(random()) - 2e9) / 3.0 * std::pow(10.0, below(9) - 6.0);
    if (!isFloat(type)) return static_cast<double>(static_cast<int32_t>(random()));
    return type == ScalarType::kFloat32 ? static_cast<double>(static_cast<float>(x)) : x;
  };
  const auto fill = [&](std::vector<std::vector<double>>& data,
                        const std::vector<Column>& columns) {
    for (size_t c = 0; c < columns.size(); ++c)
      for (int k = 0; k < columns[c].components; ++k) data[c].push_back(value(columns[c].type));
  };
  std::vector<int64_t> active;
  const auto addVertex = [&] {
    const int64_t rank = static_cast<int64_t>(m.vertexCount());
    for (int k = 0; k < 3; ++k) m.positions.push_back(value(schema.position_type));
    fill(m.fields, schema.fields);
    m.final_at.push_back(-1);
    m.events.push_back({'v', rank});
    active.push_back(rank);
  };
  const auto finalize = [&](size_t at) {
    m.final_at[static_cast<size_t>(active[at])] = static_cast<int64_t>(m.cells.size());
    active.erase(active.begin() + static_cast<std::ptrdiff_t>(at));
  };
  while (static_cast<int>(m.cells.size()) < cells) {
    while (active.size() < 6 || below(3) == 0) addVertex();
    std::shuffle(active.begin(), active.end(), random);
    m.cells.push_back({active[0], active[1], active[2], active[3]});
    m.events.push_back({'c', static_cast<int64_t>(m.cells.size()) - 1});
    fill(m.cell_data, schema.cell_data);
    uint8_t bits = 0;
    for (size_t j = 4; j-- > 0;)
      if (below(4) == 0) {
        bits |= static_cast<uint8_t>(1 << j);
        finalize(j);
      }
    m.last_uses.push_back(bits);
    while (below(5) == 0 && active.size() > 1) {
      const size_t at = below(active.size());
      m.events.push_back({'x', active[at]});
      finalize(at);
    }
  }
  return m;
}

// Every kind of column, and names that a text format has trouble with.
inline Schema richSchema() {
  Schema s;
  s.position_type = ScalarType::kFloat64;
  s.fields = {{"T", 1, ScalarType::kInt32},
              {"a name with % and nverts", 3, ScalarType::kFloat64},
              {std::string(255, 'v'), 2, ScalarType::kFloat32}};
  s.cell_data = {{"material", 1, ScalarType::kInt64}, {"E", 2, ScalarType::kFloat64}};
  return s;
}

// Hands the events to a sink, cut into batches at random; 0: as few as possible.
inline void putStream(const SvMesh& m, Sink& sink, unsigned cut_seed) {
  std::mt19937 random(cut_seed);
  sink.begin(m.schema);
  Batch batch(m.schema);
  batch.clear(0);
  int64_t next_vertex = 0;
  const auto put = [&](const std::vector<double>& from, const Column& c, int64_t row, void* to) {
    const size_t n = static_cast<size_t>(c.components);
    convertScalars(from.data() + static_cast<size_t>(row) * n, ScalarType::kFloat64, to, c.type, n);
  };
  for (const Event& e : m.events) {
    const bool must = batch.finalizedCount() > 0 && e.kind != 'x';
    if (must || (cut_seed != 0 && random() % 3 == 0)) {
      if (!batch.empty()) sink.put(batch.view());
      batch.clear(static_cast<uint64_t>(next_vertex));
    }
    const size_t rank = static_cast<size_t>(e.rank);
    if (e.kind == 'v') {
      const size_t row = batch.addVertices(1);
      convertScalars(&m.positions[3 * rank], ScalarType::kFloat64, batch.position(row),
                     m.schema.position_type, 3);
      for (size_t c = 0; c < m.fields.size(); ++c)
        put(m.fields[c], m.schema.fields[c], e.rank, batch.field(c, row));
      ++next_vertex;
    } else if (e.kind == 'c') {
      const size_t row = batch.addCells(1);
      std::copy_n(m.cells[rank].begin(), 4, batch.cell(row));
      batch.lastUses(row) = m.last_uses[rank];
      for (size_t c = 0; c < m.cell_data.size(); ++c)
        put(m.cell_data[c], m.schema.cell_data[c], e.rank, batch.cellData(c, row));
    } else {
      batch.addFinalized(e.rank);
    }
  }
  if (!batch.empty()) sink.put(batch.view());
  sink.finish();
}

inline Bytes writeBytes(Create create, const SvMesh& m, bool post_order = false,
                        unsigned cut_seed = 0, std::vector<std::string>* notes = nullptr) {
  Bytes out;
  WriteOptions options;
  options.post_order = post_order;
  if (notes) options.note = [notes](const std::string& text) { notes->push_back(text); };
  std::unique_ptr<Sink> sink = create(createMemory(out), options);
  putStream(m, *sink, cut_seed);
  return out;
}

// Cells with their data, in an order that does not depend on the file's.
inline std::vector<std::vector<double>> sortedCells(const SvMesh& m) {
  std::vector<std::vector<double>> rows;
  for (size_t i = 0; i < m.cells.size(); ++i) {
    std::vector<double> row(m.cells[i].begin(), m.cells[i].end());
    for (size_t c = 0; c < m.cell_data.size(); ++c) {
      const size_t n = static_cast<size_t>(m.schema.cell_data[c].components);
      for (size_t k = 0; k < n; ++k) row.push_back(m.cell_data[c][i * n + k]);
    }
    rows.push_back(row);
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

// However the pipe cuts the bytes, the mesh comes back.
inline void expectSameThroughPipes(Open open, Create create, const SvMesh& m,
                                   std::initializer_list<size_t> steps) {
  for (bool post_order : {false, true}) {
    const Bytes data = writeBytes(create, m, post_order);
    for (size_t step : steps) {
      const SvMesh r = readPipe(open, data, step);
      EXPECT_EQ(r.positions, m.positions);
      EXPECT_EQ(sortedCells(r), sortedCells(m));
    }
  }
}

// Every truncation and every flipped bit: an Error that names the file and says more, or a mesh
// that obeys the rules (readStream checks them).
inline void expectSurvives(Open open, const Bytes& data) {
  const auto expectSane = [open](const Bytes& bytes, const std::string& what) {
    const Error error = errorOf(open, bytes);
    if (error.status() == Status::kOk) return;
    EXPECT_TRUE(error.status() == Status::kBadData || error.status() == Status::kUnsupported)
        << what << ": " << error.text();
    EXPECT_EQ(error.text().compare(0, 6, "mesh: "), 0) << what << ": " << error.text();
    EXPECT_GT(error.text().size(), 20u) << what << ": " << error.text();
  };
  for (size_t size = 0; size < data.size(); size += oneIn(5))
    expectSane(Bytes(data.begin(), data.begin() + static_cast<std::ptrdiff_t>(size)),
               "cut to " + std::to_string(size));
  for (size_t bit = 0; bit < 8 * data.size(); bit += oneIn(9)) {
    Bytes flipped = data;
    flipped[bit / 8] = static_cast<unsigned char>(flipped[bit / 8] ^ (1u << (bit % 8)));
    expectSane(flipped, "bit " + std::to_string(bit) + " flipped");
  }
}

}  // namespace tetstream::test
