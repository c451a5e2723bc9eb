#include "xml_feed.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <vector>

namespace tetstream {

constexpr size_t kFeedBytes = 1 << 16;
constexpr uint64_t kMaxTagBytes = 1 << 20;  // of a tag or comment, which expat holds in memory
// Of a tag that may be full of entities, each of which can become kMaxEntityBytes out of three:
// with what is fed at once that is 22 MiB, before expat's own protection, which allows for more.
constexpr uint64_t kMaxTagWithEntities = 1 << 16;
constexpr size_t kMaxEntities = 64, kMaxEntityBytes = 512;  // names and paths of files

XmlFeed::XmlFeed(ByteSource& bytes, Doctype doctype)
    : bytes_(bytes), expat_(XML_ParserCreate(nullptr), XML_ParserFree) {
  if (!expat_) fail(Status::kNoMemory, "%s: no memory for the XML parser", bytes.name().c_str());
  XML_SetUserData(expat_.get(), this);
  XML_SetElementHandler(expat_.get(), onStart, onEnd);
  if (doctype == Doctype::kRefused) XML_SetStartDoctypeDeclHandler(expat_.get(), onDoctype);
  XML_SetEntityDeclHandler(expat_.get(), onEntity);
  XML_SetAttlistDeclHandler(expat_.get(), onAttlist);
  XML_SetCdataSectionHandler(expat_.get(), onCdata, onCdataEnd);
  XML_SetDefaultHandler(expat_.get(), onOther);
}

const char* XmlFeed::find(Attributes attributes, const char* name) {
  for (; *attributes; attributes += 2)
    if (std::strcmp(attributes[0], name) == 0) return attributes[1];
  return nullptr;
}

bool XmlFeed::parseUnsigned(const char* text, uint64_t* value) {
  const char* blanks = " \t\r\n";
  text += std::strspn(text, blanks);
  const char* end = text + std::strlen(text);
  const std::from_chars_result r = std::from_chars(text, end, *value);
  return r.ec == std::errc() && r.ptr + std::strspn(r.ptr, blanks) == end;
}

void XmlFeed::feed() {
  std::vector<char> buffer(kFeedBytes);
  uint64_t fed = 0;
  for (;;) {
    const size_t got = bytes_.readAt(fed, buffer.data(), buffer.size());
    const bool end = got < buffer.size();
    const XML_Status status = XML_Parse(expat_.get(), buffer.data(), static_cast<int>(got), end);
    if (error_) std::rethrow_exception(error_);
    if (stopped_) return;
    if (status != XML_STATUS_OK) failXml();
    if (end) return;
    fed += got;
    if (fed - last_event_ > (entities_.empty() ? kMaxTagBytes : kMaxTagWithEntities))
      failAt(last_event_, std::string("a tag or comment is longer than ") +
                              (entities_.empty() ? "1 MiB" : "64 KiB"));
    const bool in_text = depth_ > 0 && !in_cdata_ && last_event_ == fed;
    if (in_text) fed = passText(fed, buffer.data());
  }
}

// To the next tag.
uint64_t XmlFeed::passText(uint64_t begin, char* buffer) {
  uint64_t at = begin;
  for (;;) {
    const size_t got = bytes_.readAt(at, buffer, kFeedBytes);
    const void* tag = std::memchr(buffer, '<', got);
    at += tag ? static_cast<size_t>(static_cast<const char*>(tag) - buffer) : got;
    if (tag || got < kFeedBytes) break;
  }
  passed_ += at - begin;
  last_event_ = at;
  return at;
}

// As expat counts them, whose own count lacks what was passed over.
uint64_t XmlFeed::lineOf(uint64_t byte) const {
  std::vector<char> buffer(kFeedBytes);
  uint64_t lines = 1;
  char before = 0;
  for (uint64_t at = 0; at < byte;) {
    const auto wanted = static_cast<size_t>(std::min<uint64_t>(buffer.size(), byte - at));
    const size_t got = bytes_.readAt(at, buffer.data(), wanted);
    for (size_t i = 0; i < got; before = buffer[i++])
      lines += buffer[i] == '\r' || (buffer[i] == '\n' && before != '\r');
    if (got < wanted) break;
    at += got;
  }
  return lines;
}

void XmlFeed::failXml() {
  const XML_Error code = XML_GetErrorCode(expat_.get());
  if (code == XML_ERROR_NO_MEMORY)
    fail(Status::kNoMemory, "%s: no memory for the XML parser", bytes_.name().c_str());
  const XML_Index found = XML_GetCurrentByteIndex(expat_.get());  // -1: there is not one byte
  const uint64_t byte = found < 0 ? 0 : static_cast<uint64_t>(found) + passed_;
  const uint64_t line = passed_ > 0 ? lineOf(byte) : XML_GetCurrentLineNumber(expat_.get());
  fail(Status::kBadData, "%s: line %llu, byte %llu: not XML: %s", bytes_.name().c_str(),
       static_cast<unsigned long long>(line), static_cast<unsigned long long>(byte),
       XML_ErrorString(code));
}

void XmlFeed::failAt(uint64_t byte, const std::string& text, Status status) const {
  fail(status, "%s: byte %llu: %s", bytes_.name().c_str(), static_cast<unsigned long long>(byte),
       text.c_str());
}
void XmlFeed::stop() {
  stopped_ = true;
  XML_StopParser(expat_.get(), XML_FALSE);
}

uint64_t XmlFeed::tagBegin() const {
  return static_cast<uint64_t>(XML_GetCurrentByteIndex(expat_.get())) + passed_;
}

uint64_t XmlFeed::tagEnd() const {
  return tagBegin() + static_cast<uint64_t>(XML_GetCurrentByteCount(expat_.get()));
}

// Expat is C: no exception may pass through it.
template <class Function>
void XmlFeed::guard(Function function) noexcept {
  if (error_) return;
  try {
    last_event_ = tagEnd();
    function();
  } catch (...) {
    error_ = std::current_exception();
    XML_StopParser(expat_.get(), XML_FALSE);
  }
}

void XMLCALL XmlFeed::onStart(void* user, const XML_Char* name, Attributes attributes) {
  XmlFeed& self = *static_cast<XmlFeed*>(user);
  ++self.depth_;
  self.guard([&] { self.start(name, attributes); });
}

void XMLCALL XmlFeed::onEnd(void* user, const XML_Char*) {
  XmlFeed& self = *static_cast<XmlFeed*>(user);
  --self.depth_;
  self.guard([&] { self.end(); });
}

void XMLCALL XmlFeed::onOther(void* user, const XML_Char*, int) {
  static_cast<XmlFeed*>(user)->guard([] {});
}

void XMLCALL XmlFeed::onCdata(void* user) {
  XmlFeed& self = *static_cast<XmlFeed*>(user);
  self.in_cdata_ = true;
  self.guard([] {});
}

void XMLCALL XmlFeed::onCdataEnd(void* user) {
  XmlFeed& self = *static_cast<XmlFeed*>(user);
  self.in_cdata_ = false;
  self.guard([] {});
}

// Such as could not grow: without others in them they need no bound of how often one leads to the
// next. The first declaration of a name counts.
void XmlFeed::addEntity(const char* name, std::string text) {
  const size_t bytes = std::max(std::strlen(name), text.size());
  if (bytes > kMaxEntityBytes || entities_.size() == kMaxEntities ||
      text.find_first_of("&<") != std::string::npos)
    failHere("an entity is not read that is long, one of many or more than plain text",
             Status::kUnsupported);
  entities_.emplace(name, std::move(text));
}

void XMLCALL XmlFeed::onEntity(void* user, const XML_Char* name, int is_parameter,
                               const XML_Char* text, int size, const XML_Char*, const XML_Char*,
                               const XML_Char*, const XML_Char*) {
  XmlFeed& self = *static_cast<XmlFeed*>(user);
  self.guard([&] {
    if (is_parameter || !text)
      self.failHere("declarations of entities are not read but for those of plain text",
                    Status::kUnsupported);
    self.addEntity(name, std::string(text, static_cast<size_t>(size)));
  });
}

// Words of tags that are declared, and then kept, may be full of entities, too.
void XMLCALL XmlFeed::onAttlist(void* user, const XML_Char*, const XML_Char*, const XML_Char*,
                                const XML_Char*, int) {
  XmlFeed& self = *static_cast<XmlFeed*>(user);
  self.guard([&] {
    if (!self.entities_.empty())
      self.failHere("declarations of attributes beside entities are not read",
                    Status::kUnsupported);
  });
}

void XMLCALL XmlFeed::onDoctype(void* user, const XML_Char*, const XML_Char*, const XML_Char*,
                                int) {
  XmlFeed& self = *static_cast<XmlFeed*>(user);
  self.guard(
      [&] { self.failHere("document type declarations are not read", Status::kUnsupported); });
}

}  // namespace tetstream
