#include "tets_layout.h"

#include <algorithm>
#include <limits>

#include "checksum.h"
#include "label_names.h"
#include "status.h"

namespace tetstream::tets {

static const unsigned char kMarker[4] = {0x89, 'T', 'E', 'T'};

SectionHead makeHead(const char* id, uint32_t flags) {
  SectionHead head = {};
  std::memcpy(head.marker, kMarker, sizeof kMarker);
  std::memcpy(head.id, id, sizeof head.id);
  head.flags = flags;
  return head;
}

void seal(SectionHead& head, uint64_t rank, std::vector<unsigned char>& section) {
  section.resize(alignUp(section.size()), 0);
  head.length = section.size();
  head.rank = rank;
  head.body_checksum = checksum(0, section.data() + sizeof head, section.size() - sizeof head);
  head.head_checksum = checksum(0, &head, offsetof(SectionHead, head_checksum));
  std::memcpy(section.data(), &head, sizeof head);
}

const char* faultOf(const SectionHead& head) {
  if (std::memcmp(head.marker, kMarker, sizeof kMarker) != 0) return "has no marker";
  if (head.head_checksum != checksum(0, &head, offsetof(SectionHead, head_checksum)))
    return "does not fit its checksum";
  if (head.length < sizeof head || head.length % kAlign != 0) return "has an impossible length";
  return nullptr;
}

// -------------------------------------------------------------------------------------- boxes

Box::Box(size_t size) : min(size), max(size) {
  clear();
}

void Box::clear() {
  min.assign(min.size(), std::numeric_limits<double>::infinity());
  max.assign(max.size(), -std::numeric_limits<double>::infinity());
}

void Box::add(const Box& other) {
  for (size_t i = 0; i < min.size(); ++i) {
    if (other.min[i] < min[i]) min[i] = other.min[i];
    if (other.max[i] > max[i]) max[i] = other.max[i];
  }
}

// ------------------------------------------------------------------------------------- header

static void appendRecord(std::vector<unsigned char>& out, const Column& column) {
  ColumnRecord record;
  record.type = static_cast<uint32_t>(column.type);
  record.components = static_cast<uint32_t>(column.components);
  record.name_bytes = static_cast<uint32_t>(column.name.size());
  record.record_bytes =
      static_cast<uint32_t>((sizeof record + column.name.size() + 7) & ~size_t{7});
  const size_t end = out.size() + record.record_bytes;
  append(out, &record, sizeof record);
  append(out, column.name.data(), column.name.size());
  out.resize(end, 0);
}

static uint32_t recordBytes(const LabelName& name) {
  return static_cast<uint32_t>((sizeof(LabelNameRecord) + name.name.size() + 7) & ~size_t{7});
}

static void appendRecord(std::vector<unsigned char>& out, const Schema& schema,
                         const LabelName& name) {
  LabelNameRecord record = {};
  record.record_bytes = recordBytes(name);
  record.name_bytes = static_cast<uint32_t>(name.name.size());
  record.array = name.array.empty() ? -1 : findColumn(schema.cell_data, name.array);
  record.label = name.label;
  const size_t end = out.size() + record.record_bytes;
  append(out, &record, sizeof record);
  append(out, name.name.data(), name.name.size());
  out.resize(end, 0);
}

size_t labelNamesThatFit(const Schema& schema) {
  Schema without = schema;
  without.label_names.clear();
  size_t room = kMaxHeaderBytes - encodeHeader(without).size(), count = 0;
  for (const LabelName& name : schema.label_names) {
    if (recordBytes(name) > room) break;
    room -= recordBytes(name);
    ++count;
  }
  return count;
}

std::vector<unsigned char> encodeHeader(const Schema& schema) {
  std::vector<unsigned char> section(sizeof(SectionHead));
  HeaderStart start = {};
  start.vertices = schema.vertex_count;
  start.cells = schema.cell_count;
  start.front_width = schema.front_width;
  start.front_span = schema.front_span;
  start.front_cells = schema.front_cells;
  start.box_known = schema.hasBox();
  start.faces = std::max<int64_t>(schema.face_count, 0);
  start.time_known = schema.time.has_value();
  start.time = schema.time.value_or(0);
  append(section, &start, sizeof start);
  for (const Column& c : schema.fields) appendRecord(section, c);
  for (const Column& c : schema.cell_data) appendRecord(section, c);

  HeaderOwn own = {};
  own.byte_order = kByteOrderMark;
  own.position_type = static_cast<uint32_t>(schema.position_type);
  own.fields = static_cast<uint32_t>(schema.fields.size());
  own.cell_arrays = static_cast<uint32_t>(schema.cell_data.size());
  own.label_names = static_cast<uint32_t>(schema.label_names.size());
  own.box_offset = static_cast<uint32_t>(section.size() - sizeof(SectionHead));
  // The room is there without a box, too: it is filled in when the stream has ended.
  if (start.box_known) {
    append(section, schema.box_min.data(), schema.boxSize() * sizeof(double));
    append(section, schema.box_max.data(), schema.boxSize() * sizeof(double));
  } else {
    section.resize(section.size() + 2 * sizeof(double) * schema.boxSize(), 0);
  }
  for (const LabelName& name : schema.label_names) appendRecord(section, schema, name);
  SectionHead head = makeHead(kHeader, kMustUnderstand);
  head.value = kVersion;
  head.set(own);
  seal(head, 0, section);
  return section;
}

namespace {

// Reads the header's body from front to back.
class HeaderReader {
 public:
  HeaderReader(const unsigned char* body, size_t size, const std::string& name)
      : body_(body), size_(size), name_(name) {}

  void take(void* out, size_t bytes) {
    if (bytes > size_ - at_) tooShort();
    std::memcpy(out, body_ + at_, bytes);
    at_ += bytes;
  }
  void seek(size_t at) {
    if (at < at_ || at > size_) tooShort();
    at_ = at;
  }
  Column column() {
    ColumnRecord record;
    const size_t begin = at_;
    take(&record, sizeof record);
    if (record.record_bytes % 8 != 0 || record.record_bytes < sizeof record ||
        record.name_bytes > record.record_bytes - sizeof record || record.name_bytes > 255)
      fail(Status::kBadData, "%s: header: the column described at byte %zu has impossible sizes",
           name_.c_str(), begin + sizeof(SectionHead));
    Column column;
    column.name.resize(record.name_bytes);
    takeName(column.name, begin);
    column.type = static_cast<ScalarType>(record.type);
    column.components =
        record.components <= kMaxComponents ? static_cast<int>(record.components) : 0;
    seek(begin + record.record_bytes);
    return column;
  }
  LabelName labelName(const std::vector<Column>& cell_data) {
    LabelNameRecord record;
    const size_t begin = at_;
    take(&record, sizeof record);
    if (record.record_bytes % 8 != 0 || record.record_bytes < sizeof record ||
        record.name_bytes > record.record_bytes - sizeof record ||
        record.name_bytes > kMostNameBytes || record.array < -1 ||
        record.array >= static_cast<int64_t>(cell_data.size()))
      fail(Status::kBadData,
           "%s: header: the name of a label described at byte %zu has impossible sizes",
           name_.c_str(), begin + sizeof(SectionHead));
    LabelName name;
    if (record.array >= 0) name.array = cell_data[static_cast<size_t>(record.array)].name;
    name.label = record.label;
    name.name.resize(record.name_bytes);
    takeName(name.name, begin);
    seek(begin + record.record_bytes);
    return name;
  }

 private:
  // Of its size, of the record at `begin`.
  void takeName(std::string& name, size_t begin) {
    take(name.data(), name.size());
    if (name.find('\0') != std::string::npos)
      fail(Status::kBadData, "%s: header: the name described at byte %zu contains a zero byte",
           name_.c_str(), begin + sizeof(SectionHead));
  }
  [[noreturn]] void tooShort() const {
    fail(Status::kBadData, "%s: the header is too short for what it describes", name_.c_str());
  }
  const unsigned char* body_;
  size_t size_, at_ = 0;
  const std::string& name_;
};

}  // namespace

void checkVersion(const SectionHead& head, const std::string& name) {
  if (head.value == 0 || head.value > kVersion)
    fail(Status::kUnsupported,
         "%s: the file has version %u of the .tets format, this library reads up to version %u",
         name.c_str(), head.value, kVersion);
}

static void checkHeader(const HeaderOwn& own, const std::string& name) {
  if (own.byte_order != kByteOrderMark)
    fail(Status::kBadData, "%s: the header's byte-order mark is 0x%08x, not 0x%08x", name.c_str(),
         own.byte_order, kByteOrderMark);
  if (own.fields > kMaxColumns || own.cell_arrays > kMaxColumns)
    fail(Status::kBadData,
         "%s: the header claims %u fields and %u cell arrays, at most %u are possible",
         name.c_str(), own.fields, own.cell_arrays, kMaxColumns);
}

// Throws kBadData for what no schema may be.
static void checkDecoded(const Schema& schema, const std::string& name) {
  try {
    checkSchema(schema);
  } catch (const Error& error) {
    fail(Status::kBadData, "%s: header: %s", name.c_str(), error.text().c_str());
  }
}

Schema decodeHeader(const SectionHead& head, const unsigned char* body, size_t size,
                    const std::string& name) {
  const HeaderOwn own = head.get<HeaderOwn>();
  checkHeader(own, name);
  HeaderReader in(body, size, name);
  HeaderStart start;
  in.take(&start, sizeof start);
  Schema schema;
  schema.position_type = static_cast<ScalarType>(own.position_type);
  for (uint32_t i = 0; i < own.fields; ++i) schema.fields.push_back(in.column());
  for (uint32_t i = 0; i < own.cell_arrays; ++i) schema.cell_data.push_back(in.column());
  checkDecoded(schema, name);
  for (const int64_t known : {start.vertices, start.cells, start.front_width, start.front_span,
                              start.front_cells, start.faces})
    if (known < -1)
      fail(Status::kBadData, "%s: the header has a negative count, %lld", name.c_str(),
           static_cast<long long>(known));
  schema.vertex_count = start.vertices;
  schema.cell_count = start.cells;
  schema.face_count = start.faces > 0 ? start.faces : -1;
  schema.front_width = start.front_width;
  schema.front_span = start.front_span;
  schema.front_cells = start.front_cells;
  if (start.time_known) schema.time = start.time;
  in.seek(own.box_offset);
  std::vector<double> box(2 * schema.boxSize());
  in.take(box.data(), box.size() * sizeof(double));
  if (start.box_known) {
    schema.box_min.assign(box.begin(), box.begin() + static_cast<ptrdiff_t>(schema.boxSize()));
    schema.box_max.assign(box.begin() + static_cast<ptrdiff_t>(schema.boxSize()), box.end());
  }
  for (uint32_t i = 0; i < own.label_names; ++i)
    schema.label_names.push_back(in.labelName(schema.cell_data));
  sortLabelNames(schema.label_names);
  checkDecoded(schema, name);
  return schema;
}

// ------------------------------------------------------------------------------------- columns

static ColumnPlace place(uint32_t width, uint32_t components, bool ids = false) {
  ColumnPlace p;
  p.width = width;
  p.components = components;
  p.ids = ids;
  return p;
}

static ColumnPlace place(const Column& c) {
  return place(static_cast<uint32_t>(sizeOf(c.type)), static_cast<uint32_t>(c.components));
}

ChunkShape::ChunkShape(const Schema& schema)
    : fields_(schema.fields.size()), cell_arrays_(schema.cell_data.size()) {
  columns_.push_back(place(static_cast<uint32_t>(sizeOf(schema.position_type)), 3));
  for (const Column& c : schema.fields) columns_.push_back(place(c));
  columns_.push_back(place(1, 1));        // locked
  columns_.push_back(place(4, 4, true));  // cells
  columns_.push_back(place(1, 1));        // last uses
  for (const Column& c : schema.cell_data) columns_.push_back(place(c));
  columns_.push_back(place(8, 1, true));  // finalized
  columns_.push_back(place(4, 1));        // cells before each of them
  columns_.push_back(place(8, 3, true));  // faces
  columns_.push_back(place(8, 1));        // their labels
  columns_.push_back(place(4, 1));        // cells before each of them
}

void ChunkShape::set(const ChunkOwn& counts, uint32_t flags) {
  for (size_t i = 0; i < columns_.size(); ++i)
    columns_[i].rows = i < locked()      ? counts.vertices
                       : i < finalized() ? counts.cells
                       : i < faces()     ? counts.finalized
                                         : counts.faces;
  columns_[locked()].rows = flags & kChunkLocked ? counts.vertices : 0;
  if (!(flags & kChunkLastUses)) columns_[lastUses()].rows = 0;
  columns_[cells()].width = flags & kChunkWideCells ? 8 : 4;
  size_t at = 0;
  for (ColumnPlace& c : columns_) {
    c.offset = at;
    c.bytes = c.rows * c.bytesPerRow();
    at += alignUp(c.bytes);
  }
  payload_bytes_ = at;
}

}  // namespace tetstream::tets
