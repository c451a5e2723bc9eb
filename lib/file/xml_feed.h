// file: an XML file read in pieces by expat, of which only tags matter. Depends on bytes.h.
#pragma once

#include <expat.h>

#include <exception>
#include <map>
#include <memory>
#include <string>

#include "bytes.h"
#include "status.h"

namespace tetstream {

// Text between tags is passed over, and where there is much of it, not looked at: numbers and
// base64 tell who reads them what is wrong with them. Memory is bounded: no tag or comment may be
// longer than 1 MiB, or 64 KiB where entities are declared, which are few, short and plain.
class XmlFeed {
 public:
  using Attributes = const XML_Char**;

  // Document types: refused, or read for the entities that they declare.
  enum class Doctype { kRefused, kOfPlainEntities };

  explicit XmlFeed(ByteSource& bytes, Doctype doctype = Doctype::kRefused);
  virtual ~XmlFeed() = default;

 protected:
  virtual void start(const char* name, Attributes attributes) = 0;
  virtual void end() = 0;

  void feed();  // the whole file, or up to stop()
  void stop();  // called by start or end: the rest need not be XML
  bool stopped() const { return stopped_; }
  ByteSource& bytes() const { return bytes_; }
  // Bytes of the file: of the tag that start or end is called for, and the end of the last one.
  uint64_t tagBegin() const;
  uint64_t tagEnd() const;
  uint64_t lastEvent() const { return last_event_; }
  // By name, what they stand for, which has no markup and no other entity in it. Expat puts that
  // into the words of tags; in text they stay as they are.
  const std::map<std::string, std::string>& entities() const { return entities_; }
  [[noreturn]] void failAt(uint64_t byte, const std::string& text,
                           Status status = Status::kBadData) const;
  [[noreturn]] void failHere(const std::string& text, Status status = Status::kBadData) const {
    failAt(tagBegin(), text, status);
  }

  static const char* find(Attributes attributes, const char* name);  // null: not there
  static bool parseUnsigned(const char* text, uint64_t* value);

 private:
  [[noreturn]] void failXml();
  void addEntity(const char* name, std::string text);
  uint64_t passText(uint64_t begin, char* buffer);
  uint64_t lineOf(uint64_t byte) const;
  template <class Function>
  void guard(Function function) noexcept;
  static void XMLCALL onStart(void* user, const XML_Char* name, Attributes attributes);
  static void XMLCALL onEnd(void* user, const XML_Char* name);
  static void XMLCALL onOther(void* user, const XML_Char* text, int size);
  static void XMLCALL onCdata(void* user);
  static void XMLCALL onCdataEnd(void* user);
  static void XMLCALL onEntity(void* user, const XML_Char* name, int is_parameter,
                               const XML_Char* text, int size, const XML_Char*, const XML_Char*,
                               const XML_Char*, const XML_Char*);
  static void XMLCALL onAttlist(void* user, const XML_Char*, const XML_Char*, const XML_Char*,
                                const XML_Char*, int);
  static void XMLCALL onDoctype(void* user, const XML_Char*, const XML_Char*, const XML_Char*, int);

  ByteSource& bytes_;
  std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> expat_;
  std::exception_ptr error_;
  std::map<std::string, std::string> entities_;
  uint64_t last_event_ = 0;
  uint64_t passed_ = 0;  // bytes of text that expat has not seen
  size_t depth_ = 0;     // of elements
  bool in_cdata_ = false;
  bool stopped_ = false;
};

}  // namespace tetstream
