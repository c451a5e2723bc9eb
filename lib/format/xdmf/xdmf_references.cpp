#include "xdmf_references.h"

#include "schema.h"

namespace tetstream {

namespace {

constexpr int kMostFollowed = 16;      // from one to the next
constexpr size_t kMostMade = 1 << 17;  // items of the whole file: a few could become any number

class References {
 public:
  References(const XdmfFile& file, const XdmfText& text) : file_(file), text_(text) {}

  void follow(std::vector<XdmfItem>& items, int followed = 0) {
    for (XdmfItem& item : items) {
      int here = followed;
      for (; !item.reference.empty(); ++here) {
        const XdmfItem& meant = find(item);
        if (here == kMostFollowed)
          text_.failItem(item, Status::kBadData, "a reference leads to references without an end");
        count(item, meant);
        item = XdmfItem(meant);
      }
      follow(item.parts, here);
    }
  }

 private:
  const XdmfItem& find(const XdmfItem& item) const {
    const std::string path = sameWord(item.reference, "XML") ? text_.of(item) : item.reference;
    const std::string name = nameIn(path);
    if (name.empty())
      text_.failItem(
          item, Status::kUnsupported,
          "the reference \"" + cutName(path) +
              "\" is not followed: only those are that name a DataItem of the Domain, as "
              "/Xdmf/Domain/DataItem[@Name=\"NAME\"] does");
    const auto found = file_.named.find(name);
    if (found == file_.named.end())
      text_.failItem(item, Status::kBadData,
                     "there is no DataItem \"" + cutName(name) + "\" in the Domain");
    return found->second;
  }

  static std::string nameIn(const std::string& path) {
    for (const std::string begin : {"/Xdmf/Domain/DataItem[@Name=", "//DataItem[@Name="}) {
      const size_t name = begin.size() + 1;
      if (!path.starts_with(begin) || path.size() < name + 3) continue;
      const char quote = path[name - 1];
      const size_t end = path.size() - 2;
      if ((quote == '"' || quote == '\'') && path[end] == quote && path[end + 1] == ']')
        return path.substr(name, end - name);
    }
    return "";
  }

  void count(const XdmfItem& item, const XdmfItem& made) {
    if (++made_ > kMostMade)
      text_.failItem(item, Status::kUnsupported, "the references lead to too many arrays");
    for (const XdmfItem& part : made.parts) count(item, part);
  }

  const XdmfFile& file_;
  const XdmfText& text_;
  size_t made_ = 0;
};

}  // namespace

void followXdmfReferences(XdmfFile& file, const XdmfText& text) {
  References references(file, text);
  for (XdmfGrid& grid : file.grids) {
    if (grid.topology) references.follow(grid.topology->items);
    if (grid.geometry) references.follow(grid.geometry->items);
    for (XdmfAttribute& attribute : grid.attributes) references.follow(attribute.items);
    references.follow(grid.times);
  }
}

}  // namespace tetstream
