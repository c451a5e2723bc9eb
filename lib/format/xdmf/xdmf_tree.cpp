#include "xdmf_tree.h"

#include <strings.h>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "mesh_pieces.h"
#include "text_number.h"

namespace tetstream {

bool sameWord(const std::string& a, const char* b) {
  return strcasecmp(a.c_str(), b) == 0;
}

uint64_t XdmfItem::count() const {
  uint64_t count = sizes.empty() ? 0 : 1;
  for (const uint64_t size : sizes) count *= size;  // bounded when they are read
  return count;
}

bool XdmfItem::isUntyped() const {
  return !is_slab && !has_kind && sameWord(format, "XML");
}

namespace {

constexpr size_t kMaxGrids = 1 << 18, kMaxItems = 1 << 20;
constexpr size_t kMaxDepth = 64;
// References copy items, which therefore are small, whatever the file says.
constexpr size_t kMaxWord = 64, kMaxDirections = 32, kMaxReference = 1024;

class XdmfTree final : XmlFeed {
 public:
  explicit XdmfTree(ByteSource& bytes)
      : XmlFeed(bytes, Doctype::kOfPlainEntities),
        name_(bytes.name().substr(bytes.name().rfind('/') + 1)) {}

  XdmfFile run() {
    feed();
    XdmfFile file;
    file.grids = std::move(grids_);
    for (size_t i = 0; i < named_.size(); ++i) file.named.emplace(names_[i], std::move(named_[i]));
    file.entities = entities();
    return file;
  }

 private:
  // What the tags that are open hold; kOther is passed over with all that is in it.
  enum Open { kRoot, kDomain, kGrid, kTopology, kGeometry, kAttribute, kTimes, kItem, kOther };

  void start(const char* name, Attributes attributes) override {
    if (open_.size() == kMaxDepth) failHere("the tags are nested too deeply", Status::kUnsupported);
    open_.push_back(kindOf(name, attributes));
  }

  void end() override {
    const Open closed = open_.back();
    open_.pop_back();
    if (closed == kItem) {
      items_open_.back()->end = std::max(tagBegin(), items_open_.back()->begin);
      items_open_.pop_back();
    }
    if (closed == kGrid) grid_ = grids_[static_cast<size_t>(grid_)].parent;
    if (holdsItems(closed)) items_ = nullptr;
  }

  static bool holdsItems(Open open) {
    return open == kTopology || open == kGeometry || open == kAttribute || open == kTimes;
  }

  Open kindOf(const char* name, Attributes attributes) {
    if (open_.empty()) {
      if (std::strcmp(name, "Xdmf") != 0)
        failHere("this is no XDMF file: it begins with <" + cutName(name) + ">");
      return kRoot;
    }
    const Open in = open_.back();
    if (in == kRoot && std::strcmp(name, "Domain") == 0) return kDomain;
    if ((in == kDomain || in == kGrid) && std::strcmp(name, "Grid") == 0)
      return addGrid(attributes);
    if (in == kGrid) return addToGrid(name, attributes);
    if (std::strcmp(name, "DataItem") != 0) return kOther;
    if (holdsItems(in)) return addItem(attributes, *items_);
    if (in == kDomain) return addNamed(attributes);
    if (in == kItem && items_open_.back()->is_slab)
      return addItem(attributes, items_open_.back()->parts);
    return kOther;
  }

  static std::string wordOf(Attributes attributes, const char* name, const char* otherwise) {
    const char* found = find(attributes, name);
    return found ? found : otherwise;
  }

  static std::optional<uint64_t> numberOf(Attributes attributes, const char* name) {
    const char* found = find(attributes, name);
    uint64_t number = 0;
    if (!found || !parseUnsigned(found, &number)) return {};
    return number;
  }

  Open addGrid(Attributes attributes) {
    if (grids_.size() == kMaxGrids) failHere("there are too many grids", Status::kUnsupported);
    XdmfGrid grid;
    grid.name = wordOf(attributes, "Name", "");
    const std::string type = wordOf(attributes, "GridType", "Uniform");
    if (sameWord(type, "Collection"))
      grid.kind = sameWord(wordOf(attributes, "CollectionType", "Spatial"), "Temporal")
                      ? XdmfGrid::kTemporal
                      : XdmfGrid::kSpatial;
    else if (sameWord(type, "Tree"))
      grid.kind = XdmfGrid::kSpatial;
    else if (!sameWord(type, "Uniform"))
      failHere("a grid of the type \"" + cutName(type) + "\" is not read", Status::kUnsupported);
    grid.parent = grid_;
    grid_ = static_cast<int>(grids_.size());
    grids_.push_back(std::move(grid));
    return kGrid;
  }

  Open addToGrid(const char* name, Attributes attributes) {
    XdmfGrid& grid = grids_[static_cast<size_t>(grid_)];
    if (std::strcmp(name, "Topology") == 0) {
      needCounting(attributes, "BaseOffset");
      needCounting(attributes, "Order");
      grid.topology.emplace();
      grid.topology->type =
          wordOf(attributes, "TopologyType", wordOf(attributes, "Type", "").c_str());
      items_ = &grid.topology->items;
      return kTopology;
    }
    if (std::strcmp(name, "Geometry") == 0) {
      grid.geometry.emplace();
      grid.geometry->type =
          wordOf(attributes, "GeometryType", wordOf(attributes, "Type", "XYZ").c_str());
      items_ = &grid.geometry->items;
      return kGeometry;
    }
    if (std::strcmp(name, "Attribute") == 0) {
      // libxdmf writes all words that it knows, with nothing in those that do not apply.
      grid.attributes.push_back({wordOf(attributes, "Name", ""),
                                 wordOf(attributes, "Center", "Node"),
                                 wordOf(attributes, "AttributeType", ""),
                                 !wordOf(attributes, "ItemType", "").empty(),
                                 wordOf(attributes, "ElementFamily", ""),
                                 wordOf(attributes, "ElementCell", ""),
                                 numberOf(attributes, "ElementDegree"),
                                 {}});
      items_ = &grid.attributes.back().items;
      return kAttribute;
    }
    if (std::strcmp(name, "Time") == 0) {
      const char* const value = find(attributes, "Value");
      if (value) grid.time = realIn(value).value_or(std::nan(""));
      const std::string type = wordOf(attributes, "TimeType", "");
      grid.has_even_times = sameWord(type, "HyperSlab");
      if (grid.has_even_times || sameWord(type, "List")) {
        items_ = &grid.times;
        return kTimes;
      }
    }
    const char* local = std::strrchr(name, ':');
    if (std::strcmp(local ? local + 1 : name, "include") == 0) addInclude(attributes, grid);
    grid.has_sets = grid.has_sets || std::strcmp(name, "Set") == 0;
    return kOther;
  }

  void addInclude(Attributes attributes, XdmfGrid& grid) const {
    const std::string file = wordOf(attributes, "href", "");
    if (file.empty() || file == name_)
      grid.includes.push_back(wordOf(attributes, "xpointer", ""));
    else if (grid.other_file.empty())
      grid.other_file = file;
  }

  // Of a word whose numbers are 0, 1, 2 ... unless cells have other points than those of their
  // numbers, or in another order.
  void needCounting(Attributes attributes, const char* word) const {
    const char* at = find(attributes, word);
    char* end = nullptr;
    for (long count = 0; at; ++count, at = end) {
      const long number = std::strtol(at, &end, 10);
      if (end == at) return;
      if (number != count)
        failHere(textOf("the %s of a Topology is not followed", word), Status::kUnsupported);
    }
  }

  static bool isSlab(Attributes attributes) {
    const bool old_slab = sameWord(wordOf(attributes, "Type", ""), "HyperSlab");
    return sameWord(typeOfItem(attributes), "HyperSlab") ||
           (old_slab && !find(attributes, "ItemType"));
  }
  static std::string typeOfItem(Attributes attributes) {
    return wordOf(attributes, "ItemType", "Uniform");
  }
  static bool isRead(Attributes attributes) {
    return isSlab(attributes) || sameWord(typeOfItem(attributes), "Uniform");
  }

  // For references to it; of other types nothing may be wanted.
  Open addNamed(Attributes attributes) {
    const std::string name = wordOf(attributes, "Name", "");
    if (name.empty() || !isRead(attributes)) return kOther;
    try {
      const Open open = addItem(attributes, named_);
      names_.push_back(name);
      return open;
    } catch (const Error&) {
      return kOther;  // who refers to it is told that it is not there
    }
  }

  Open addItem(Attributes attributes, std::vector<XdmfItem>& items) {
    if (!isRead(attributes))
      failHere("a DataItem of the type \"" + cutName(typeOfItem(attributes)) + "\" is not read",
               Status::kUnsupported);
    if (++item_count_ > kMaxItems) failHere("there are too many arrays", Status::kUnsupported);
    items.push_back(itemOf(attributes));
    items_open_.push_back(&items.back());
    return kItem;
  }

  XdmfItem itemOf(Attributes attributes) const {
    const auto word = [&](const char* name, const std::string& otherwise) {
      return wordOf(attributes, name, otherwise.c_str()).substr(0, kMaxWord);
    };
    XdmfItem item;
    item.format = word("Format", "XML");
    item.kind = word("NumberType", word("DataType", "Float"));
    item.has_kind = find(attributes, "NumberType") || find(attributes, "DataType");
    const char* precision = find(attributes, "Precision");
    if (precision && !parseUnsigned(precision, &item.precision))
      failHere("a Precision is no number");
    const char* seek = find(attributes, "Seek");
    if (seek && !parseUnsigned(seek, &item.seek)) failHere("a Seek is no number of bytes");
    item.order = word("Endian", "Native");
    item.compression = word("Compression", "Raw");
    item.reference = wordOf(attributes, "Reference", "");
    if (item.reference.size() > kMaxReference) failHere("a Reference is too long");
    readSizes(wordOf(attributes, "Dimensions", ""), item);
    item.is_slab = isSlab(attributes);
    item.begin = item.end = tagEnd();
    return item;
  }

  void readSizes(const std::string& text, XdmfItem& item) const {
    uint64_t count = 1;
    const char* end = text.data() + text.size();
    for (const char* at = text.data(); at < end;) {
      if (std::strchr(" \t\r\n", *at)) {
        ++at;
        continue;
      }
      uint64_t size = 0;
      const std::from_chars_result r = std::from_chars(at, end, size);
      if (r.ec != std::errc() || size > kMaxMeshCount ||
          (size > 0 && count > 9 * kMaxMeshCount / size) || item.sizes.size() == kMaxDirections)
        failHere("the Dimensions \"" + cutName(text) + "\" are none");
      count *= size;
      item.sizes.push_back(size);
      at = r.ptr;
    }
  }

  const std::string name_;  // of the file, without its folder
  std::vector<XdmfGrid> grids_;
  std::vector<Open> open_;
  int grid_ = -1;  // that is open
  std::vector<XdmfItem>* items_ = nullptr;
  std::vector<XdmfItem*> items_open_;  // each a part of the one before
  std::vector<XdmfItem> named_;
  std::vector<std::string> names_;  // of each of those
  size_t item_count_ = 0;
};

}  // namespace

XdmfFile readXdmfTree(ByteSource& bytes) {
  return XdmfTree(bytes).run();
}

}  // namespace tetstream
