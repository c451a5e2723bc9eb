#include "vtu_encode.h"

#include <zlib.h>
#ifdef TETSTREAM_WITH_LZ4
#include <lz4.h>
#endif
#ifdef TETSTREAM_WITH_LZMA
#include <lzma.h>
#endif

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace tetstream::test {

std::string encodeBase64(const std::string& bytes) {
  const char* alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t group = 0;
    for (size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? alphabet[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

namespace {

template <class T>
void appendNumber(std::string& out, T value, bool big_endian) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  if (big_endian != (std::endian::native == std::endian::big))
    std::reverse(bytes, bytes + sizeof(T));
  out.append(bytes, sizeof(T));
}

std::string valuesOf(const VtuTestArray& a, bool big) {
  std::string out;
  for (double v : a.reals) {
    if (a.type == "Float32")
      appendNumber(out, static_cast<float>(v), big);
    else
      appendNumber(out, v, big);
  }
  for (int64_t v : a.integers) {
    if (a.type.ends_with("8"))
      appendNumber(out, static_cast<int8_t>(v), big);
    else if (a.type.ends_with("16"))
      appendNumber(out, static_cast<int16_t>(v), big);
    else if (a.type.ends_with("32"))
      appendNumber(out, static_cast<int32_t>(v), big);
    else
      appendNumber(out, v, big);
  }
  return out;
}

std::string textOf(const VtuTestArray& a) {
  std::string out;
  char word[64];
  for (double v : a.reals) {
    std::snprintf(word, sizeof word, a.type == "Float32" ? "%.9g " : "%.17g ", v);
    out += word;
  }
  for (int64_t v : a.integers)
    out += (a.type[0] == 'U' ? std::to_string(static_cast<uint64_t>(v)) : std::to_string(v)) + "\n";
  return out;
}

#ifdef TETSTREAM_WITH_LZMA
// A dictionary larger than the block would never be filled, but be cleared for each.
std::string byLzma(const std::string& bytes, std::string out) {
  lzma_options_lzma options;
  lzma_lzma_preset(&options, 1);
  const auto size = static_cast<uint32_t>(bytes.size());
  options.dict_size = std::clamp<uint32_t>(size, LZMA_DICT_SIZE_MIN, options.dict_size);
  lzma_filter filters[] = {{LZMA_FILTER_LZMA2, &options}, {LZMA_VLI_UNKNOWN, nullptr}};
  size_t made = 0;
  const lzma_ret result = lzma_stream_buffer_encode(
      filters, LZMA_CHECK_CRC32, nullptr, reinterpret_cast<const uint8_t*>(bytes.data()),
      bytes.size(), reinterpret_cast<uint8_t*>(out.data()), &made, out.size());
  if (result != LZMA_OK) std::abort();
  out.resize(made);
  return out;
}
#endif

std::string compressed(const std::string& bytes, const std::string& codec) {
  std::string out(bytes.size() + 1024, '\0');
#ifdef TETSTREAM_WITH_LZ4
  if (codec == "lz4") {
    out.resize(static_cast<size_t>(LZ4_compress_default(
        bytes.data(), out.data(), static_cast<int>(bytes.size()), static_cast<int>(out.size()))));
    return out;
  }
#endif
#ifdef TETSTREAM_WITH_LZMA
  if (codec == "lzma") return byLzma(bytes, std::move(out));
#endif
  uLongf size = static_cast<uLongf>(out.size());
  compress(reinterpret_cast<Bytef*>(out.data()), &size,
           reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()));
  out.resize(size);
  return out;
}

void appendWord(std::string& out, size_t word, const VtuStyle& style) {
  if (style.header_bits == 64)
    appendNumber(out, static_cast<uint64_t>(word), style.big_endian);
  else
    appendNumber(out, static_cast<uint32_t>(word), style.big_endian);
}

std::string encoded(const VtuTestArray& a, const VtuStyle& style) {
  const std::string values = valuesOf(a, style.big_endian);
  const bool raw = style.coding == VtuCoding::kAppendedRaw;
  std::string head, body = values;
  if (!style.zlib) {
    appendWord(head, values.size(), style);
    if (raw) return head + values;
    return style.header_apart ? encodeBase64(head) + encodeBase64(values)
                              : encodeBase64(head + values);
  }
  std::string sizes;
  body.clear();
  for (size_t i = 0; i < values.size(); i += style.block_bytes) {
    const std::string block = compressed(values.substr(i, style.block_bytes), style.codec);
    appendWord(sizes, block.size(), style);
    body += block;
  }
  appendWord(head, (values.size() + style.block_bytes - 1) / style.block_bytes, style);
  appendWord(head, style.block_bytes, style);
  appendWord(head, values.size() % style.block_bytes, style);
  head += sizes;
  return raw ? head + body : encodeBase64(head) + encodeBase64(body);
}

void addSection(std::string& xml, std::string& appended, const char* element,
                const std::vector<VtuTestArray>& arrays, const VtuStyle& style) {
  static const char* const formats[] = {"ascii", "binary", "appended", "appended"};
  xml += std::string("<") + element + ">\n";
  for (const VtuTestArray& a : arrays) {
    xml += "<DataArray " + a.attributes + " format='" + formats[static_cast<int>(style.coding)] +
           "' type=\"" + a.type + "\"";
    if (!a.name.empty()) xml += "\n Name=\"" + a.name + "\"";
    if (a.components != 1) xml += " NumberOfComponents=\"" + std::to_string(a.components) + "\"";
    if (style.coding == VtuCoding::kAscii) {
      xml += ">\n" + textOf(a) + "</DataArray>\n";
    } else if (style.coding == VtuCoding::kInline) {
      xml += ">\n  " + encoded(a, style) + "\n</DataArray>\n";
    } else {
      xml += " offset=\"" + std::to_string(appended.size()) + "   \"/>\n";
      appended += encoded(a, style);
    }
  }
  xml += std::string("</") + element + ">\n";
}

}  // namespace

std::string makeVtu(const std::vector<VtuTestPiece>& pieces, const VtuStyle& style) {
  std::string xml = "<VTKFile type=\"UnstructuredGrid\"", appended;
  if (style.big_endian) xml += " byte_order=\"BigEndian\"";
  if (style.header_bits == 64) xml += " header_type=\"UInt64\"";
  const std::string codec = style.codec;
  if (style.zlib)
    xml += std::string(" compressor=\"vtk") +
           (codec == "lz4"    ? "LZ4"
            : codec == "lzma" ? "LZMA"
                              : "ZLib") +
           "DataCompressor\"";
  xml += "><UnstructuredGrid>\n";
  for (const VtuTestPiece& piece : pieces) {
    xml += "<Piece NumberOfPoints=\"" + std::to_string(piece.points) + "  \" NumberOfCells=\"" +
           std::to_string(piece.cells) + "\">\n";
    addSection(xml, appended, "PointData", piece.point_data, style);
    addSection(xml, appended, "CellData", piece.cell_data, style);
    addSection(xml, appended, "Points", piece.points_element, style);
    addSection(xml, appended, "Cells", piece.cells_element, style);
    xml += "</Piece>\n";
  }
  xml += "</UnstructuredGrid>\n";
  if (style.coding >= VtuCoding::kAppendedBase64) {
    const char* name = style.coding == VtuCoding::kAppendedRaw ? "raw" : "base64";
    xml += std::string("<AppendedData encoding=\"") + name + "\">\n _" + appended +
           "\n</AppendedData>";
  }
  return xml + "</VTKFile>\n";
}

VtuTestPiece twoCellPiece(const std::string& point_type, const std::string& id_type) {
  VtuTestPiece piece;
  piece.points = 5;
  piece.cells = 2;
  piece.point_data = {{"Float32", "p", 1, {0.5, -1.25, 1e-7, 3, 1e30}, {}}};
  piece.cell_data = {{"Int32", "region", 1, {}, {7, -7}}};
  piece.points_element = {
      {point_type, "Points", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0.1}, {}}};
  piece.cells_element = {{id_type, "connectivity", 1, {}, {0, 1, 2, 3, 1, 2, 3, 4}},
                         {id_type, "offsets", 1, {}, {4, 8}},
                         {"UInt8", "types", 1, {}, {10, 10}}};
  return piece;
}

}  // namespace tetstream::test
