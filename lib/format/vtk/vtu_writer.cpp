// Writes .vtu files (VTK XML unstructured grids), values appended raw. The counts and sizes that
// stand in front are known only at the end, so the arrays go through temporary files. Labelled
// faces are triangles after the tetrahedra.
#include <algorithm>
#include <bit>
#include <memory>
#include <vector>

#include "dropped_marks.h"
#include "field_time.h"
#include "held_names.h"
#include "status.h"
#include "text_number.h"
#include "trailing_faces.h"
#include "vtk_cells.h"
#include "vtk_format.h"
#include "vtu_spool.h"

namespace tetstream {

namespace {

constexpr size_t kMadeAtOnce = 1024;  // cells whose types and offsets are made

const char* nameOf(ScalarType type) {
  switch (type) {
    case ScalarType::kFloat32:
      return "Float32";
    case ScalarType::kFloat64:
      return "Float64";
    case ScalarType::kInt32:
      return "Int32";
    case ScalarType::kInt64:
      return "Int64";
  }
  return "";
}

// Bytes of the UTF-8 character that begins `text`, 0 if it is none.
size_t characterBytes(const std::string& text, size_t at) {
  const auto byte = [&](size_t i) {
    return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0u;
  };
  const unsigned lead = byte(0);
  if (lead < 0x80) return 1;
  const size_t size = lead >= 0xF5 ? 0 : lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : lead >= 0xC2 ? 2 : 0;
  for (size_t i = 1; i < size; ++i)
    if ((byte(i) & 0xC0) != 0x80) return 0;
  // Overlong forms, surrogates, past the last character.
  const unsigned second = byte(1);
  if ((lead == 0xE0 && second < 0xA0) || (lead == 0xED && second >= 0xA0) ||
      (lead == 0xF0 && second < 0x90) || (lead == 0xF4 && second >= 0x90))
    return 0;
  if (lead == 0xEF && second == 0xBF && byte(2) >= 0xBE) return 0;  // no characters of XML
  return size;
}

// What XML cannot hold becomes '_'.
std::string plain(const std::string& text) {
  std::string out;
  for (size_t at = 0; at < text.size();) {
    const char c = text[at];
    const size_t size = characterBytes(text, at);
    const bool is_control = static_cast<unsigned char>(c) < 0x20;
    if (size == 0 || (is_control && c != '\t' && c != '\n' && c != '\r'))
      out += '_';
    else
      out.append(text, at, size);
    at += std::max<size_t>(size, 1);
  }
  return out;
}

// As the value of an XML attribute.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (c == '\t' || c == '\n' || c == '\r')
      out += "&#" + std::to_string(static_cast<int>(c)) + ";";
    else
      out += c;
  }
  return out;
}

class VtuWriter final : public Sink {
 public:
  VtuWriter(std::unique_ptr<ByteSink> bytes, const WriteOptions& options)
      : bytes_(std::move(bytes)),
        options_(options),
        dropped_(*bytes_, options, ".vtu"),
        faces_(*bytes_, options) {}

  void begin(const Schema& schema) override {
    checkSchema(schema);
    schema_ = schema;
    for (std::vector<Column>* columns : {&schema_.fields, &schema_.cell_data}) {
      const std::vector<std::string> held =
          heldNames(*columns, plain, [this](const std::string& text) { note(text); });
      for (size_t i = 0; i < held.size(); ++i) (*columns)[i].name = held[i];
    }
    if (options_.compress) compressor_ = std::make_unique<BlockCompressor>();
    points_ = makeSpool();
    connectivity_ = makeSpool();
    for (size_t i = 0; i < schema.fields.size(); ++i) fields_.push_back(makeSpool());
    for (size_t i = 0; i < schema.cell_data.size(); ++i) cell_data_.push_back(makeSpool());
  }

  void put(const BatchView& batch) override {
    const size_t vertices = batch.vertex_count, cells = batch.cell_count;
    if (vertices > 0)
      points_->append(batch.positions, vertices * 3 * sizeOf(schema_.position_type));
    for (size_t i = 0; vertices > 0 && i < fields_.size(); ++i)
      fields_[i]->append(batch.fields[i], vertices * schema_.fields[i].bytesPerRow());
    if (cells > 0) connectivity_->append(batch.cells, cells * 4 * sizeof(int64_t));
    for (size_t i = 0; cells > 0 && i < cell_data_.size(); ++i)
      cell_data_[i]->append(batch.cell_data[i], cells * schema_.cell_data[i].bytesPerRow());
    vertex_count_ += vertices;
    cell_count_ += cells;
    faces_.put(batch, vertex_count_, schema_.cell_data);
    dropped_.lookAtLocks(batch);
  }

  void finish() override {
    makeKinds();
    faces_.close();
    if (faces_.count() > 0) appendFaces();
    std::vector<VtuSpool*> order;
    const std::string header = makeHeader(&order);
    BufferedSink sink(*bytes_);
    sink.write(header.data(), header.size());
    for (VtuSpool* spool : order) spool->write(sink);
    const std::string tail = "\n  </AppendedData>\n</VTKFile>\n";
    sink.write(tail.data(), tail.size());
    sink.flush();
    bytes_->commit();
  }

 private:
  using Spool = std::unique_ptr<VtuSpool>;

  Spool makeSpool() { return std::make_unique<VtuSpool>(options_.temp_dir, compressor_.get()); }

  void note(const std::string& text) {
    if (options_.note) options_.note(bytes_->name() + ": " + text);
  }

  // A cell's offset is that of its end in the connectivity.
  void makeKinds() {
    offsets_ = makeSpool();
    types_ = makeSpool();
    appendKinds(kVtkTetra, 4, cell_count_, 0);
  }

  void appendKinds(unsigned char type, int64_t points, uint64_t count, int64_t before) {
    int64_t offsets[kMadeAtOnce];
    const std::vector<unsigned char> types(kMadeAtOnce, type);
    for (uint64_t done = 0; done < count;) {
      const auto n = static_cast<size_t>(std::min<uint64_t>(count - done, kMadeAtOnce));
      for (size_t i = 0; i < n; ++i)
        offsets[i] = before + points * static_cast<int64_t>(done + i + 1);
      offsets_->append(offsets, n * sizeof(int64_t));
      types_->append(types.data(), n);
      done += n;
    }
  }

  // What only cells of the other kind have is zero.
  void appendFaces() {
    const uint64_t count = faces_.count();
    appendKinds(kVtkTriangle, 3, count, static_cast<int64_t>(4 * cell_count_));
    for (size_t i = 0; i < cell_data_.size(); ++i)
      appendZeros(*cell_data_[i], count * schema_.cell_data[i].bytesPerRow());
    Spool labels = makeSpool();
    appendZeros(*labels, cell_count_ * sizeof(int64_t));
    faces_.forAll([&](const TrailingFaces::Face& face) {
      connectivity_->append(face.vertices, sizeof face.vertices);
      labels->append(&face.label, sizeof face.label);
    });
    schema_.cell_data.push_back(TrailingFaces::labels());
    cell_data_.push_back(std::move(labels));
    cell_count_ += count;
  }

  // Adds the line of an array and its values after those before it.
  void addArray(const std::string& name, const char* type, int components, VtuSpool& spool,
                std::vector<VtuSpool*>* order) {
    spool.close();
    text_ += "        <DataArray type=\"" + std::string(type) + "\" Name=\"" + escaped(name) + "\"";
    if (components != 1) text_ += " NumberOfComponents=\"" + std::to_string(components) + "\"";
    text_ += " format=\"appended\" offset=\"" + std::to_string(offset_) + "\"/>\n";
    offset_ += spool.encodedBytes();
    order->push_back(&spool);
  }

  void addColumns(const char* element, const std::vector<Column>& columns,
                  const std::vector<Spool>& spools, std::vector<VtuSpool*>* order) {
    text_ += std::string("      <") + element + activeOf(columns) + ">\n";
    for (size_t i = 0; i < columns.size(); ++i)
      addArray(columns[i].name, nameOf(columns[i].type), columns[i].components, *spools[i], order);
    text_ += std::string("      </") + element + ">\n";
  }

  // What viewers show at first: the first float scalar, the first float vector.
  static std::string activeOf(const std::vector<Column>& columns) {
    std::string scalars, vectors;
    for (const Column& c : columns) {
      if (!isFloat(c.type)) continue;
      if (c.components == 1 && scalars.empty()) scalars = " Scalars=\"" + escaped(c.name) + "\"";
      if (c.components == 3 && vectors.empty()) vectors = " Vectors=\"" + escaped(c.name) + "\"";
    }
    return scalars + vectors;
  }

  // As VTK's readers look for it.
  void addTime(double time) {
    text_ += textOf(
        "    <FieldData>\n      <DataArray type=\"Float64\" Name=\"%s\" "
        "NumberOfTuples=\"1\" format=\"ascii\">",
        kVtkTime);
    printNumber(&time, ScalarType::kFloat64, text_);
    text_ += "</DataArray>\n    </FieldData>\n";
  }

  std::string makeHeader(std::vector<VtuSpool*>* order) {
    const bool little = std::endian::native == std::endian::little;
    text_ =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"";
    text_ += little ? "LittleEndian" : "BigEndian";
    text_ += "\" header_type=\"UInt64\"";
    if (compressor_) text_ += " compressor=\"vtkZLibDataCompressor\"";
    text_ += ">\n  <UnstructuredGrid>\n";
    if (schema_.time) addTime(*schema_.time);
    text_ += "    <Piece NumberOfPoints=\"" + std::to_string(vertex_count_) +
             "\" NumberOfCells=\"" + std::to_string(cell_count_) + "\">\n";
    addColumns("PointData", schema_.fields, fields_, order);
    addColumns("CellData", schema_.cell_data, cell_data_, order);
    text_ += "      <Points>\n";
    addArray("Points", nameOf(schema_.position_type), 3, *points_, order);
    text_ += "      </Points>\n      <Cells>\n";
    addArray("connectivity", "Int64", 1, *connectivity_, order);
    addArray("offsets", "Int64", 1, *offsets_, order);
    addArray("types", "UInt8", 1, *types_, order);
    text_ +=
        "      </Cells>\n    </Piece>\n  </UnstructuredGrid>\n"
        "  <AppendedData encoding=\"raw\">\n   _";
    return std::move(text_);
  }

  std::unique_ptr<ByteSink> bytes_;
  WriteOptions options_;
  DroppedMarks dropped_;
  TrailingFaces faces_;
  Schema schema_;
  std::unique_ptr<BlockCompressor> compressor_;
  Spool points_, connectivity_, offsets_, types_;
  std::vector<Spool> fields_, cell_data_;
  uint64_t vertex_count_ = 0, cell_count_ = 0, offset_ = 0;
  std::string text_;
};

}  // namespace

std::unique_ptr<Sink> createVtu(std::unique_ptr<ByteSink> bytes, const WriteOptions& options) {
  return std::make_unique<VtuWriter>(std::move(bytes), options);
}

}  // namespace tetstream
