#include "tables.h"

#include <algorithm>
#include <cstring>
#include <map>

#include "failure.h"
#include "progress.h"

namespace alpenglow::cli {
namespace {

// A slice is one submission. This long is short enough for any driver's watchdog and long enough
// that submitting costs nothing.
constexpr double kSliceSeconds = 0.25;
constexpr uint64_t kFirstBudget = 2'000'000;

TablesPointer emptyTables(Session* session, const Parameters& parameters, const TableDesc& desc) {
  Tables* tables = nullptr;
  session->check(createTables(session->context(), parameters, desc, &tables));
  return TablesPointer(tables, TablesDeleter{session});
}

// Of the parts that every table file has.
TableId idOf(const std::string& part) {
  static const std::map<std::string, TableId> kIds = {{"optical_depth", kTableOpticalDepth},
                                                      {"moments", kTableMoments},
                                                      {"source", kTableSource},
                                                      {"irradiance", kTableIrradiance},
                                                      {"scattering", kTableScattering},
                                                      {"single_mie", kTableSingleMie}};
  return kIds.at(part);
}

ImageInfo imageOf(const Tables* tables, TableId id) {
  TablesInfo info;
  tablesInfo(tables, &info);
  return info.images[id];
}

TableFormat formatOf(const ImageInfo& info) {
  return info.format == VK_FORMAT_R32G32B32A32_SFLOAT ? TableFormat::Float : TableFormat::Half;
}

io::TablePart readTable(Session* session, Tables* tables, TableId id, const std::string& name) {
  const ImageInfo info = imageOf(tables, id);
  const headless::HostBuffer buffer =
      session->hostBuffer(info.bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  session->run([&](VkCommandBuffer commands) {
    session->check(recordTableReadback(tables, commands, id, buffer.buffer(), 0));
    return "readback";
  });
  io::TablePart part{name, info.extent.width, info.extent.height, info.extent.depth, formatOf(info),
                     {}};
  part.texels.resize(info.bytes);
  std::memcpy(part.texels.data(), buffer.data(), info.bytes);
  return part;
}

struct OrderTable {
  const char* pass;  ///< "dS n" finishes it for order n.
  TableId id;
  const char* part;
};
constexpr OrderTable kOrderTables[] = {{"N ", kTableOrderMoments, "moments"},
                                       {"J ", kTableOrderSource, "source"},
                                       {"dS ", kTableOrderScattering, "scattering"},
                                       {"dS ", kTableOrderSingleMie, "single_mie"},
                                       {"dS ", kTableOrderIrradiance, "irradiance"}};

// Appends the tables of single orders that the pass has finished.
void keepOrder(Session* session, Tables* tables, const BakeProgress& progress,
               std::vector<io::TablePart>* kept) {
  if (!progress.passFinished || progress.order == 0) return;
  for (const OrderTable& table : kOrderTables) {
    const bool finished = std::string(progress.pass).rfind(table.pass, 0) == 0;
    const bool exists = table.id != kTableOrderSingleMie || progress.order == 1;
    if (!finished || !exists) continue;
    const std::string name = table.part + ("_order_" + std::to_string(progress.order));
    kept->push_back(readTable(session, tables, table.id, name));
  }
}

uint64_t nextBudget(uint64_t recorded, double seconds) {
  const double wanted = static_cast<double>(std::max<uint64_t>(recorded, 1)) * kSliceSeconds /
                        std::max(seconds, 1e-4);
  // Not more than four times as much at once: the next pass may cost more for each unit.
  return static_cast<uint64_t>(
      std::clamp(wanted, 1e5, 4.0 * static_cast<double>(std::max<uint64_t>(recorded, 100'000))));
}

TablesPointer uploadTables(Session* session, const Parameters& parameters, io::TableFile file) {
  TablesPointer tables = emptyTables(session, parameters, file.desc);
  for (io::TablePart& part : file.parts) {
    const TableId id = idOf(part.name);
    const ImageInfo info = imageOf(tables.get(), id);
    io::convertTexels(&part, formatOf(info));  // Devices differ in which tables are float.
    const headless::HostBuffer buffer =
        session->hostBuffer(part.texels.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    std::memcpy(buffer.data(), part.texels.data(), part.texels.size());
    session->run([&](VkCommandBuffer commands) {
      session->check(recordTableUpload(tables.get(), commands, id, buffer.buffer(), 0));
      return "upload";
    });
    session->nextFrame();
  }
  return tables;
}

}  // namespace

TablesPointer bakeTables(Session* session, const Parameters& parameters, const TableDesc& desc,
                         std::vector<io::TablePart>* kept) {
  TablesPointer tables = emptyTables(session, parameters, desc);
  Progress bar("Baking");
  uint64_t budget = kFirstBudget;
  BakeProgress progress;
  while (!progress.done) {
    const double seconds = session->run([&](VkCommandBuffer commands) {
      session->check(recordBake(tables.get(), commands, budget, &progress));
      return std::string(progress.pass);
    });
    budget = nextBudget(progress.unitsRecorded, seconds);
    bar.update(static_cast<double>(progress.unitsDone) / static_cast<double>(progress.unitsTotal),
               progress.pass);
    if (kept != nullptr) keepOrder(session, tables.get(), progress, kept);
    session->nextFrame();
  }
  return tables;
}

std::vector<io::TablePart> readTables(Session* session, Tables* tables, const TableDesc& desc) {
  std::vector<io::TablePart> parts;
  for (const io::TablePart& part : io::expectedParts(desc)) {
    parts.push_back(readTable(session, tables, idOf(part.name), part.name));
  }
  return parts;
}

ReadyTables obtainTables(Session* session, const Parameters& parameters, TableRequest request) {
  if (request.file) {
    return {uploadTables(session, parameters, std::move(*request.file)), request.desc};
  }
  return {bakeTables(session, parameters, request.desc, nullptr), request.desc};
}

}  // namespace alpenglow::cli
