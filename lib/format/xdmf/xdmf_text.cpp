#include "xdmf_text.h"

#include <algorithm>

#include "schema.h"

namespace tetstream {

namespace {

constexpr uint64_t kMaxTextBytes = 4096;

// What XML itself declares.
constexpr struct {
  const char *name, *meant;
} kOfXml[] = {{"amp", "&"}, {"lt", "<"}, {"gt", ">"}, {"quot", "\""}, {"apos", "'"}};

}  // namespace

std::string XdmfText::placeOf(const XdmfItem& item) const {
  return textOf("%s: byte %llu", bytes_->name().c_str(),
                static_cast<unsigned long long>(item.begin));
}

void XdmfText::failItem(const XdmfItem& item, Status status, const std::string& text) const {
  fail(status, "%s: %s", placeOf(item).c_str(), text.c_str());
}

std::string XdmfText::of(const XdmfItem& item) const {
  if (item.end - item.begin > kMaxTextBytes)
    failItem(item, Status::kBadData, "the name of a dataset is too long");
  std::string text(static_cast<size_t>(item.end - item.begin), 0);
  text.resize(bytes_->readAt(item.begin, text.data(), text.size()));
  const char* blanks = " \t\r\n";
  const size_t first = text.find_first_not_of(blanks);
  if (first == std::string::npos) return "";
  return withoutEntities(item, text.substr(first, text.find_last_not_of(blanks) - first + 1));
}

// What one stands for is plain and is not looked at again, so the text cannot grow far.
std::string XdmfText::withoutEntities(const XdmfItem& item, const std::string& text) const {
  std::string out;
  for (size_t at = 0; at < text.size();) {
    const size_t begin = text.find('&', at);
    out += text.substr(at, begin - at);
    if (begin == std::string::npos) break;
    const size_t end = std::min(text.find(';', begin), text.size());
    out += meaningOf(item, text.substr(begin + 1, end - begin - 1));
    at = end + 1;
  }
  return out;
}

std::string XdmfText::meaningOf(const XdmfItem& item, const std::string& entity) const {
  const auto found = entities_.find(entity);
  if (found != entities_.end()) return found->second;
  for (const auto& row : kOfXml)
    if (entity == row.name) return row.meant;
  failItem(item, Status::kBadData, "\"&" + cutName(entity) + ";\" stands for nothing");
}

}  // namespace tetstream
