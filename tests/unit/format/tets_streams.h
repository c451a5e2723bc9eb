// tests: small streams with everything that a `.tets` file can hold, and ways to write, read,
// compare and take apart such files.
#pragma once

#include <gtest/gtest.h>
#include <algorithm>
#include <cstring>
#include <map>

#include "meshes.h"
#include "pipes.h"
#include "registry.h"
#include "status.h"
#include "tets_format.h"
#include "tets_layout.h"

namespace tetstream::test {

// What a stream says, without regard to batches: the events with their places.
struct Events {
  Bytes positions, locked, last_uses;
  std::vector<Bytes> fields, cell_data;
  std::vector<int64_t> cells;
  std::vector<int64_t> finalized;  // vertex, number of cells before
  std::vector<int64_t> faces;      // corners, label, number of cells before the batch's end
  bool operator==(const Events&) const = default;

  void add(const Schema& schema, const BatchView& b) {
    fields.resize(schema.fields.size());
    cell_data.resize(schema.cell_data.size());
    const auto append = [](Bytes& to, const void* from, size_t bytes) {
      const unsigned char* in = static_cast<const unsigned char*>(from);
      if (bytes) to.insert(to.end(), in, in + bytes);
    };
    append(positions, b.positions, b.vertex_count * 3 * sizeOf(schema.position_type));
    for (size_t i = 0; i < fields.size(); ++i)
      if (b.vertex_count)
        append(fields[i], b.fields[i], b.vertex_count * schema.fields[i].bytesPerRow());
    for (size_t i = 0; i < b.vertex_count; ++i) locked.push_back(b.locked ? b.locked[i] : 0);
    EXPECT_EQ(b.first_vertex + b.vertex_count, locked.size());
    for (size_t i = 0; i < 4 * b.cell_count; ++i) {
      EXPECT_LT(b.cells[i], static_cast<int64_t>(locked.size()));
      cells.push_back(b.cells[i]);
    }
    for (size_t i = 0; i < b.cell_count; ++i) last_uses.push_back(b.last_uses ? b.last_uses[i] : 0);
    for (size_t i = 0; i < cell_data.size(); ++i)
      if (b.cell_count)
        append(cell_data[i], b.cell_data[i], b.cell_count * schema.cell_data[i].bytesPerRow());
    const int64_t place = static_cast<int64_t>(last_uses.size());
    for (size_t i = 0; i < b.finalized_count; ++i)
      finalized.insert(finalized.end(), {b.finalized[i], place});
    for (size_t i = 0; i < b.face_count; ++i)
      faces.insert(faces.end(), {b.faces[3 * i], b.faces[3 * i + 1], b.faces[3 * i + 2],
                                 b.face_labels[i], place});
  }
};

// A stream kept as batches.
struct Stream {
  Schema schema;
  std::vector<Batch> batches;
  Events events() {
    Events e;
    for (Batch& b : batches) e.add(schema, b.view());
    return e;
  }
};

struct Wanted {
  ScalarType position_type = ScalarType::kFloat32;
  std::vector<Column> fields, cell_data;
  size_t batch_cells = 100;
  bool locked = false, faces = false, last_uses = true;
  size_t explicit_every = 0;  // every n-th finalization is an explicit one at the batch's end
};

// Rows whose bytes tell column and row.
inline void fillRow(void* out, const Column& column, size_t number, size_t row) {
  for (int j = 0; j < column.components; ++j) {
    const int64_t label = static_cast<int64_t>(row * 31 + number * 7 + static_cast<size_t>(j));
    const double value = 0.1 * static_cast<double>(label) - 3;
    convertScalars(isFloat(column.type) ? static_cast<const void*>(&value) : &label,
                   isFloat(column.type) ? ScalarType::kFloat64 : ScalarType::kInt64,
                   static_cast<char*>(out) + static_cast<size_t>(j) * sizeOf(column.type),
                   column.type, 1);
  }
}

inline Stream streamOf(const SmallMesh& mesh, const Wanted& wanted) {
  Stream s;
  s.schema.position_type = wanted.position_type;
  s.schema.fields = wanted.fields;
  s.schema.cell_data = wanted.cell_data;
  std::map<int64_t, size_t> last;  // vertex -> the last corner that uses it
  for (size_t i = 0; i < mesh.cells.size(); ++i) last[mesh.cells[i]] = i;
  uint64_t vertices = 0;
  size_t finalizations = 0;
  for (size_t cell = 0; cell < mesh.cellCount();) {
    Batch batch(s.schema);
    batch.clear(vertices);
    const size_t end = std::min(cell + wanted.batch_cells, mesh.cellCount());
    const auto top = std::max_element(mesh.cells.begin() + static_cast<ptrdiff_t>(4 * cell),
                                      mesh.cells.begin() + static_cast<ptrdiff_t>(4 * end));
    for (; vertices <= static_cast<uint64_t>(*top); ++vertices) {
      const size_t row = batch.addVertices(1);
      convertScalars(&mesh.positions[3 * vertices], ScalarType::kFloat64, batch.position(row),
                     s.schema.position_type, 3);
      for (size_t i = 0; i < s.schema.fields.size(); ++i)
        fillRow(batch.field(i, row), s.schema.fields[i], i, static_cast<size_t>(vertices));
      if (wanted.locked && vertices % 5 == 0) batch.lock(row);
    }
    for (; cell < end; ++cell) {
      const size_t row = batch.addCells(1);
      std::memcpy(batch.cell(row), &mesh.cells[4 * cell], 4 * sizeof(int64_t));
      for (size_t i = 0; i < s.schema.cell_data.size(); ++i)
        fillRow(batch.cellData(i, row), s.schema.cell_data[i], 50 + i, cell);
      for (size_t j = 0; j < 4; ++j) {
        const int64_t vertex = mesh.cells[4 * cell + j];
        if (last[vertex] != 4 * cell + j || (!wanted.last_uses && !wanted.explicit_every)) continue;
        if (wanted.explicit_every && ++finalizations % wanted.explicit_every == 0)
          batch.addFinalized(vertex);
        else if (wanted.last_uses)
          batch.lastUses(row) |= static_cast<uint8_t>(1u << j);
      }
      if (wanted.faces && cell % 3 == 0)
        batch.addFace(&mesh.cells[4 * cell], static_cast<int64_t>(cell) - 10);
    }
    s.batches.push_back(std::move(batch));
  }
  return s;
}

inline Stream oneCellStream() {
  SmallMesh mesh;
  mesh.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  mesh.cells = {0, 1, 2, 3};
  Wanted wanted;
  wanted.fields = {{"f", 1, ScalarType::kFloat32}};
  return streamOf(mesh, wanted);
}

// The example of tetstream-formats(5): one cell, f = 0.5 1 1.5 2.
inline Stream example() {
  Stream s = oneCellStream();
  for (size_t i = 0; i < 4; ++i) {
    const float f = 0.5f * static_cast<float>(i + 1);
    std::memcpy(s.batches[0].field(0, i), &f, sizeof f);
  }
  return s;
}

inline void writeTo(Stream& s, std::unique_ptr<ByteSink> bytes, bool compress) {
  WriteOptions options;
  options.compress = compress;
  const std::unique_ptr<Sink> sink = createTets(std::move(bytes), options);
  sink->begin(s.schema);
  for (Batch& b : s.batches) sink->put(b.view());
  sink->finish();
}

inline Bytes write(Stream& s, bool compress = false) {
  Bytes out;
  writeTo(s, createMemory(out), compress);
  return out;
}

inline Bytes writePiped(Stream& s) {
  Bytes out;
  writeTo(s, std::make_unique<PipeSink>(out), true);
  return out;
}

inline Events readFrom(std::unique_ptr<ByteSource> bytes, Schema* schema = nullptr) {
  const Input input = openTets(std::move(bytes), {});
  Events events;
  BatchView batch;
  while (input.stream->next(batch)) events.add(input.schema(), batch);
  EXPECT_FALSE(input.stream->next(batch));
  if (schema) *schema = input.schema();
  return events;
}

inline Events read(const Bytes& bytes, Schema* schema = nullptr) {
  return readFrom(openMemory(bytes.data(), bytes.size(), "memory"), schema);
}

inline Events readPiped(const Bytes& bytes, Schema* schema = nullptr) {
  return readFrom(std::make_unique<PipeSource>(bytes, 0), schema);
}

// The sentence with which reading fails; its status, too.
inline std::string failureOf(const Bytes& bytes, bool piped, Status* status) {
  *status = Status::kOk;
  try {
    if (piped)
      readPiped(bytes);
    else
      read(bytes);
  } catch (const Error& error) {
    *status = error.status();
    return error.text();
  }
  return "";
}

// ------------------------------------------------------------------- files, taken apart

struct Section {
  tets::SectionHead head;
  Bytes body;
};

inline std::vector<Section> sectionsOf(const Bytes& file) {
  std::vector<Section> out;
  for (size_t at = 0; at < file.size();) {
    Section s;
    std::memcpy(&s.head, file.data() + at, sizeof s.head);
    s.body.assign(file.begin() + static_cast<ptrdiff_t>(at + sizeof s.head),
                  file.begin() + static_cast<ptrdiff_t>(at + s.head.length));
    at += s.head.length;
    out.push_back(std::move(s));
  }
  return out;
}

// Puts sections together again with right ranks, places, lengths and checksums, whatever was done
// to the rest of them.
inline Bytes joined(std::vector<Section> sections) {
  Bytes file;
  std::vector<uint64_t> chunk_offsets, chunk_lengths;
  uint64_t rank = 0, last_index = 0, totals = 0;
  size_t indexed = 0;
  for (Section& s : sections) {
    if (s.head.is(tets::kChunk)) {
      chunk_offsets.push_back(file.size());
      chunk_lengths.push_back(sizeof s.head + tets::alignUp(s.body.size()));
    } else if (s.head.is(tets::kIndex)) {
      tets::IndexOwn own = s.head.get<tets::IndexOwn>();
      own.previous = last_index;
      s.head.set(own);
      last_index = file.size();
      for (size_t i = 0; indexed < chunk_offsets.size(); ++i, ++indexed) {
        const uint64_t where[2] = {chunk_offsets[indexed], chunk_lengths[indexed]};
        std::memcpy(s.body.data() + i * sizeof(tets::IndexEntry), where, sizeof where);
      }
    } else if (s.head.is(tets::kTotals)) {
      totals = file.size();
    } else if (s.head.is(tets::kEnd)) {
      s.head.set(tets::EndOwn{totals, last_index, file.size() + sizeof s.head});
    }
    Bytes section(sizeof s.head + s.body.size());
    if (!s.body.empty()) std::memcpy(section.data() + sizeof s.head, s.body.data(), s.body.size());
    tets::seal(s.head, rank++, section);
    file.insert(file.end(), section.begin(), section.end());
  }
  return file;
}

}  // namespace tetstream::test
