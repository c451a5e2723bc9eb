#include "tile_contacts.h"

namespace tetstream {

// A tile of a cube's eight shares a twentieth as many cells with those across an edge or a corner
// of it as it has vertices, and half as many with those across a face: too many to be left out.
constexpr size_t kVerticesPerShared = 8;
constexpr int kRounds = 8;  // at most; two are enough for most windows

void TileContacts::reset(size_t tiles) {
  of_.resize(tiles);
  for (std::vector<Contact>& contacts : of_) contacts.clear();
  side_.assign(tiles, 0);
  apart_.resize(tiles);
  for (std::vector<uint32_t>& others : apart_) others.clear();
}

auto TileContacts::between(uint32_t a, uint32_t b) -> Contact& {
  std::vector<Contact>& contacts = of_[a];
  for (Contact& contact : contacts)
    if (contact.tile == b) return contact;
  contacts.push_back({b, 0, false});
  return contacts.back();
}

void TileContacts::add(uint32_t a, uint32_t b, size_t cells) {
  between(a, b).cells += cells;
  between(b, a).cells += cells;
}

void TileContacts::add(const TileContacts& others) {
  for (uint32_t a = 0; a < others.of_.size(); ++a)
    for (const Contact& contact : others.of_[a]) between(a, contact.tile).cells += contact.cells;
}

// The side with fewer shared cells, of what is shared with the first `known` tiles. Whether that is
// another one than before.
bool TileContacts::takeBetterSide(uint32_t tile, uint32_t known) {
  size_t shared[2] = {0, 0};
  for (const Contact& contact : of_[tile])
    if (contact.tile < known) shared[side_[contact.tile]] += contact.cells;
  const int before = side_[tile];
  if (shared[1 - before] < shared[before]) side_[tile] = 1 - before;
  return side_[tile] != before;
}

void TileContacts::divide(const std::vector<size_t>& sizes) {
  const auto tiles = static_cast<uint32_t>(of_.size());
  for (uint32_t tile = 1; tile < tiles; ++tile) takeBetterSide(tile, tile);
  bool changes = true;
  for (int round = 0; changes && round < kRounds; ++round) {
    changes = false;
    for (uint32_t tile = 0; tile < tiles; ++tile) changes |= takeBetterSide(tile, tiles);
  }
  for (uint32_t tile = 0; tile < tiles; ++tile) {
    apart_[tile].clear();
    for (Contact& contact : of_[tile]) {
      contact.apart =
          side_[tile] == side_[contact.tile] &&
          contact.cells <= std::min(sizes[tile], sizes[contact.tile]) / kVerticesPerShared;
      if (contact.apart) apart_[tile].push_back(contact.tile);
    }
  }
}

}  // namespace tetstream
