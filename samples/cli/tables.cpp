#include "tables.h"

#include <alpenglow/io/atmosphere_file.h>

#include <algorithm>
#include <cstring>

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

TableFormat formatOf(const TableInfo& info) {
  return info.format == VK_FORMAT_R32G32B32A32_SFLOAT ? TableFormat::Float : TableFormat::Half;
}

io::TablePart readTable(Session* session, Tables* tables, TableId id, const std::string& name) {
  TableInfo info;
  session->check(tableInfo(tables, id, &info));
  const headless::HostBuffer buffer =
      session->hostBuffer(info.bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  session->run([&](VkCommandBuffer commands) {
    session->check(recordTableReadback(tables, commands, id, buffer.buffer(), 0));
    return "readback";
  });
  io::TablePart part{name, info.width, info.height, info.depth, formatOf(info), {}};
  part.texels.resize(info.bytes);
  std::memcpy(part.texels.data(), buffer.data(), info.bytes);
  return part;
}

void keepOrder(Session* session, Tables* tables, uint32_t order, std::vector<io::TablePart>* kept) {
  const std::string suffix = "_order_" + std::to_string(order);
  kept->push_back(readTable(session, tables, TableId::OrderScattering, "scattering" + suffix));
  if (order == 1) {
    kept->push_back(readTable(session, tables, TableId::OrderSingleMie, "single_mie" + suffix));
  }
  kept->push_back(readTable(session, tables, TableId::OrderIrradiance, "irradiance" + suffix));
}

uint64_t nextBudget(uint64_t recorded, double seconds) {
  const double wanted = static_cast<double>(std::max<uint64_t>(recorded, 1)) * kSliceSeconds /
                        std::max(seconds, 1e-4);
  // Not more than four times as much at once: the next pass may cost more for each unit.
  return static_cast<uint64_t>(
      std::clamp(wanted, 1e5, 4.0 * static_cast<double>(std::max<uint64_t>(recorded, 100'000))));
}

std::string otherwise(const std::string& path, const std::string& asked, const std::string& holds) {
  return asked + " was asked for, but the table file '" + path + "' holds " + holds + ".";
}

// Throws when an option, or the scene, asks for other tables than the file's.
void checkAgainst(const TableArguments& arguments, const io::Scene* scene, const TableDesc& file) {
  const std::string& path = arguments.tables;
  const TableDesc wanted = describeTables(arguments, scene);
  const auto compare = [&](bool given, const char* option, const std::string& asked,
                           const std::string& holds) {
    if (given && asked != holds) {
      throw Failure(otherwise(path, std::string(option) + " " + asked, holds));
    }
  };
  const bool sceneOrders = scene != nullptr && scene->orders.has_value();
  compare(arguments.orders || sceneOrders,
          arguments.orders ? "--orders" : "\"orders\":", std::to_string(wanted.orders),
          std::to_string(file.orders));
  compare(arguments.sizeTransmittance.has_value(), "--size-transmittance",
          io::transmittanceSizeText(wanted.sizes), io::transmittanceSizeText(file.sizes));
  compare(arguments.sizeIrradiance.has_value(), "--size-irradiance",
          io::irradianceSizeText(wanted.sizes), io::irradianceSizeText(file.sizes));
  compare(arguments.sizeScattering.has_value(), "--size-scattering",
          io::scatteringSizeText(wanted.sizes), io::scatteringSizeText(file.sizes));
  const auto format = [](const TableDesc& d) {
    return d.format == TableFormat::Half ? "half" : "float";
  };
  compare(arguments.format.has_value(), "--format", format(wanted), format(file));
  const auto mie = [](const TableDesc& d) { return d.mie == MieStorage::Full ? "full" : "packed"; };
  compare(arguments.mie.has_value(), "--mie", mie(wanted), mie(file));
}

TablesPointer uploadTables(Session* session, const Parameters& parameters, io::TableFile file) {
  TablesPointer tables = emptyTables(session, parameters, file.desc);
  const std::pair<TableId, const char*> ids[] = {{TableId::OpticalDepth, "optical_depth"},
                                                 {TableId::Irradiance, "irradiance"},
                                                 {TableId::Scattering, "scattering"},
                                                 {TableId::SingleMie, "single_mie"}};
  for (const auto& entry : ids) {
    const TableId id = entry.first;
    const std::string name = entry.second;
    const auto part = std::find_if(file.parts.begin(), file.parts.end(),
                                   [&](const io::TablePart& p) { return p.name == name; });
    if (part == file.parts.end()) continue;  // Packed; the reader has checked all others.
    TableInfo info;
    session->check(tableInfo(tables.get(), id, &info));
    io::convertTexels(&*part, formatOf(info));  // Devices differ in the optical depth's format.
    const headless::HostBuffer buffer =
        session->hostBuffer(part->texels.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    std::memcpy(buffer.data(), part->texels.data(), part->texels.size());
    session->run([&](VkCommandBuffer commands) {
      session->check(recordTableUpload(tables.get(), commands, session->device().frame(), id,
                                       buffer.buffer(), 0));
      return "upload";
    });
  }
  return tables;
}

}  // namespace

TableDesc describeTables(const TableArguments& arguments, const io::Scene* scene) {
  TableDesc desc;
  if (scene != nullptr) desc.orders = scene->orders.value_or(0);
  if (arguments.orders) desc.orders = parseOrders(*arguments.orders);
  if (arguments.format) {
    desc.format = *arguments.format == "half" ? TableFormat::Half : TableFormat::Float;
  }
  if (arguments.mie) {
    desc.mie = *arguments.mie == "full" ? MieStorage::Full : MieStorage::Packed;
  }
  if (arguments.sizeTransmittance) {
    io::parseTransmittanceSize(*arguments.sizeTransmittance, &desc.sizes);
  }
  if (arguments.sizeIrradiance) io::parseIrradianceSize(*arguments.sizeIrradiance, &desc.sizes);
  if (arguments.sizeScattering) io::parseScatteringSize(*arguments.sizeScattering, &desc.sizes);
  desc.keepOrders = arguments.keepOrders;
  desc = io::resolved(desc);
  check(io::checkSizes(desc));
  return desc;
}

TablesPointer bakeTables(Session* session, const Parameters& parameters, const TableDesc& desc,
                         std::vector<io::TablePart>* kept) {
  TablesPointer tables = emptyTables(session, parameters, desc);
  Progress bar("Baking");
  uint64_t budget = kFirstBudget;
  BakeProgress progress;
  while (!progress.done) {
    const double seconds = session->run([&](VkCommandBuffer commands) {
      session->check(
          recordBake(tables.get(), commands, session->device().frame(), budget, &progress));
      return std::string(progress.pass);
    });
    budget = nextBudget(progress.unitsRecorded, seconds);
    bar.update(static_cast<double>(progress.unitsDone) / static_cast<double>(progress.unitsTotal),
               progress.pass);
    // "dS n" finishes order n.
    const bool orderDone = progress.passFinished && std::strncmp(progress.pass, "dS ", 3) == 0;
    if (kept != nullptr && orderDone) keepOrder(session, tables.get(), progress.order, kept);
  }
  return tables;
}

std::vector<io::TablePart> readTables(Session* session, Tables* tables, const TableDesc& desc) {
  std::vector<io::TablePart> parts;
  parts.push_back(readTable(session, tables, TableId::OpticalDepth, "optical_depth"));
  parts.push_back(readTable(session, tables, TableId::Irradiance, "irradiance"));
  parts.push_back(readTable(session, tables, TableId::Scattering, "scattering"));
  if (desc.mie == MieStorage::Full) {
    parts.push_back(readTable(session, tables, TableId::SingleMie, "single_mie"));
  }
  return parts;
}

io::TableFile loadTableFile(const TableArguments& arguments, const Parameters& parameters,
                            const io::Scene* scene) {
  io::TableFile file = take(io::readTableFile(arguments.tables));
  const std::string difference =
      io::firstDifference(file.parameters, parameters, " in it", " in the atmosphere asked for");
  if (!difference.empty()) {
    throw Failure("The table file '" + arguments.tables +
                  "' was baked for another atmosphere: " + difference + ".");
  }
  checkAgainst(arguments, scene, file.desc);
  return file;
}

TableRequest requestTables(const TableArguments& arguments, const Parameters& parameters,
                           const io::Scene* scene) {
  TableRequest request;
  if (arguments.tables.empty()) {
    request.desc = describeTables(arguments, scene);
    return request;
  }
  request.file = loadTableFile(arguments, parameters, scene);
  request.desc = request.file->desc;
  return request;
}

ReadyTables obtainTables(Session* session, const Parameters& parameters, TableRequest request) {
  if (request.file) {
    return {uploadTables(session, parameters, std::move(*request.file)), request.desc};
  }
  return {bakeTables(session, parameters, request.desc, nullptr), request.desc};
}

}  // namespace alpenglow::cli
