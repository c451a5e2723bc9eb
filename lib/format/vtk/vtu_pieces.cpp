#include "vtu_pieces.h"

#include "time_steps.h"
#include "vtu_run.h"
#include "vtu_side_by_side.h"

namespace tetstream {

namespace {

struct OpenVtu {
  std::unique_ptr<ByteSource> bytes;
  VtuFile file;
};

MeshArray arrayOf(const std::shared_ptr<OpenVtu>& vtu, const VtuArray& array) {
  return {array.name, array.type, array.components, [vtu, &array](uint64_t count) {
            return openVtuValues(*vtu->bytes, vtu->file, array, count);
          }};
}

std::optional<MeshArray> arrayOf(const std::shared_ptr<OpenVtu>& vtu,
                                 const std::optional<VtuArray>& array) {
  return array ? std::optional(arrayOf(vtu, *array)) : std::nullopt;
}

}  // namespace

void addVtuPieces(MeshPieces& mesh, std::unique_ptr<ByteSource> bytes, const ReadOptions& options) {
  mesh.name = bytes->name();
  VtuFile parsed = parseVtuHeader(*bytes, [&](const std::vector<double>& times) {
    return chooseStep(mesh, times.size(), options,
                      [&](uint64_t step) { return times[static_cast<size_t>(step)]; });
  });
  parsed.helpers = {options.threads, std::this_thread::get_id()};
  if (parsed.compressor && parsed.helpers.areHere()) bytes = openShared(std::move(bytes));
  const auto vtu = std::make_shared<OpenVtu>(OpenVtu{std::move(bytes), std::move(parsed)});
  for (const std::string& note : vtu->file.notes) mesh.addNote(note);
  if (!vtu->file.global_ids.empty()) mesh.global_ids = vtu->file.global_ids;
  if (vtu->file.time)
    takeTime(mesh, readTime(mesh, [&] { return timeIn(*arrayOf(vtu, *vtu->file.time).open(1)); }));
  for (const VtuPiece& piece : vtu->file.pieces) {
    MeshPiece added;
    added.point_count = piece.point_count;
    added.cell_count = piece.cell_count;
    for (const VtuArray& array : piece.point_data) added.point_data.push_back(arrayOf(vtu, array));
    for (const VtuArray& array : piece.cell_data) added.cell_data.push_back(arrayOf(vtu, array));
    added.points = arrayOf(vtu, piece.points);
    added.connectivity = arrayOf(vtu, piece.connectivity);
    added.offsets = arrayOf(vtu, piece.offsets);
    added.types = arrayOf(vtu, piece.types);
    mesh.add(std::move(added));
  }
}

}  // namespace tetstream
