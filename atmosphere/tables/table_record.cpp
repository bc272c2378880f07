// What Tables record: slices of the bake, readback and upload.
#include <algorithm>

#include "atmosphere/tables/table_set.h"

namespace alpenglow {
inline namespace v1_0 {
namespace {

using tables::isOrderTable;
using tables::kNoImage;

/// What a table is called, and which solver has it.
struct TableKind {
  const char* name;
  bool moments, standard;
};
constexpr TableKind kTableKinds[kTableIdCount] = {
    {"optical_depth", true, true},     {"moments", true, false},
    {"source", true, false},           {"irradiance", false, true},
    {"scattering", false, true},       {"single_mie", false, true},
    {"order moments", true, false},    {"order source", true, false},
    {"order irradiance", false, true}, {"order scattering", false, true},
    {"order single Mie", false, true}};

VkBufferImageCopy wholeCopy(const engine::Image& image, VkDeviceSize offset) {
  VkBufferImageCopy copy = {};
  copy.bufferOffset = offset;
  copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  copy.imageExtent = image.desc.extent;
  return copy;
}

const char* nameOf(TableId id) {
  return id < kTableIdCount ? kTableKinds[id].name : "of an unknown TableId";
}

}  // namespace

Status Tables::recordBake(VkCommandBuffer commands, uint64_t budget, BakeProgress* progress) {
  if (!bakes_) {
    return device_.fail(Status::Unsupported, VK_SUCCESS,
                        "recordBake needs a context with kCapabilityBake, but this one was made "
                        "without it: its tables can only be uploaded.");
  }
  if (state_.uploaded != 0) {
    return device_.fail(Status::InvalidArgument, VK_SUCCESS,
                        "recordBake was called on tables that were filled by recordTableUpload, "
                        "but a bake needs tables of its own.");
  }
  const Status noted = noteFrame();
  if (noted != Status::Ok) return noted;
  const uint32_t passCount = static_cast<uint32_t>(graph_.passes.size());
  BakeProgress now;
  now.passCount = passCount;
  now.unitsTotal = unitsTotal_;
  if (state_.pass < passCount) {
    const tables::Pass& pass = graph_.passes[state_.pass];
    const tables::Stage& stage = graph_.stages[pass.stage];
    const uint64_t tilesLeft =
        (stage.rows - state_.row + tables::kTileRows - 1) / tables::kTileRows;
    const uint64_t tilesWanted =
        budget / std::max<uint64_t>(stage.unitsPerRow() * tables::kTileRows, 1);
    const uint64_t tiles = std::clamp<uint64_t>(budget == 0 ? tilesLeft : tilesWanted, 1, 65535);
    const uint32_t endRow = static_cast<uint32_t>(
        std::min<uint64_t>(stage.rows, state_.row + tiles * tables::kTileRows));
    const Status status = recordPass(commands, pass, state_.row, endRow);
    if (status != Status::Ok) return status;
    now.unitsRecorded = (endRow - state_.row) * stage.unitsPerRow();
    now.passIndex = state_.pass;
    now.pass = pass.name;
    now.order = pass.order;
    now.passFinished = endRow == stage.rows;
    state_.unitsDone += now.unitsRecorded;
    state_.row = now.passFinished ? 0 : endRow;
    state_.pass += now.passFinished ? 1 : 0;
    if (state_.pass == passCount) {
      const Status finished = finish(commands);
      if (finished != Status::Ok) return finished;
    }
  }
  now.unitsDone = state_.unitsDone;
  now.done = state_.ready;
  if (progress != nullptr) *progress = now;
  return Status::Ok;
}

Status Tables::recordPass(VkCommandBuffer commands, const tables::Pass& pass, uint32_t firstRow,
                          uint32_t endRow) {
  const engine::Dispatch& vk = device_.vk();
  const tables::Stage& stage = graph_.stages[pass.stage];
  const StageObjects& objects = stages_[pass.stage];
  engine::Barriers barriers;
  for (const tables::StageInput& input : stage.inputs)
    barriers.image(images_[input.image], engine::kComputeSampled);
  for (const tables::StageOutput& output : stage.outputs) {
    // One image may fill the bindings of missing ones; one barrier is enough.
    if (&output != stage.outputs.data() && output.image == stage.outputs[0].image) continue;
    engine::Image& image = images_[output.image];
    if (output.accumulates) {
      barriers.image(image, engine::kComputeReadWrite);
    } else if (firstRow == 0) {
      barriers.discard(image, engine::kComputeWrite);
    } else {
      barriers.image(image, engine::kComputeWrite);
    }
  }
  const Status status = barriers.record(device_, commands);
  if (status != Status::Ok) return status;

  device_.beginLabel(commands, pass.name);
  const VkDescriptorSet sets[] = {objects.inputs, objects.outputs};
  const tables::TileConstants tile = {firstRow, endRow, stage.width, stage.height};
  vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, objects.pipeline);
  vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, resources_.pipelineLayout(), 0,
                           2, sets, 0, nullptr);
  vk.CmdPushConstants(commands, resources_.pipelineLayout(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                      sizeof tile, &tile);
  vk.CmdDispatch(commands, (stage.width + 7) / 8,
                 (endRow - firstRow + tables::kTileRows - 1) / tables::kTileRows, 1);
  device_.endLabel(commands);
  ++device_.counters().dispatches;
  return Status::Ok;
}

engine::ImageState Tables::readable() const {
  return {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, desc_.readerStages,
          VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
}

// After it the image is in the layout of transfers; barriers are the caller's.
void Tables::copyToBuffer(VkCommandBuffer commands, engine::Image& image, VkBuffer buffer,
                          VkDeviceSize offset) {
  const VkBufferImageCopy copy = wholeCopy(image, offset);
  device_.vk().CmdCopyImageToBuffer(commands, image.handle, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                    buffer, 1, &copy);
}

Status Tables::recordHostCopies(VkCommandBuffer commands) {
  if (desc_.cpuQueries == CpuQueries::None) return Status::Ok;
  engine::Barriers barriers;
  for (const TableId id : {kTableOpticalDepth, kTableMoments, kTableSource})
    if (hostCopies_[id].handle != VK_NULL_HANDLE)
      barriers.image(images_[imageOf(id)], engine::kTransferSource);
  Status status = barriers.record(device_, commands);
  if (status != Status::Ok) return status;
  for (const TableId id : {kTableOpticalDepth, kTableMoments, kTableSource})
    if (hostCopies_[id].handle != VK_NULL_HANDLE)
      copyToBuffer(commands, images_[imageOf(id)], hostCopies_[id].handle, 0);
  barriers.memory(VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                  VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
  return barriers.record(device_, commands);
}

// The last thing that makes tables ready, of a bake or an upload.
Status Tables::finish(VkCommandBuffer commands) {
  Status status = recordHostCopies(commands);
  if (status != Status::Ok) return status;
  engine::Barriers barriers;
  for (size_t i = 0; i < images_.size(); ++i)
    if (graph_.images[i].persistent) barriers.image(images_[i], readable());
  status = barriers.record(device_, commands);
  if (status != Status::Ok) return status;
  state_.ready = true;
  state_.readyFrame = device_.submitting();
  return Status::Ok;
}

TablesState Tables::state() const {
  const bool begun = state_.unitsDone != 0 || state_.uploaded != 0;
  if (!state_.ready) return begun ? TablesState::Baking : TablesState::Empty;
  return state_.readyFrame <= device_.completed() ? TablesState::Complete : TablesState::Recorded;
}

// Only once the last frame has completed: after an abandoned frame it is needed again.
void Tables::frameCompleted(uint64_t completed) {
  const bool needed = desc_.keepOrders && state_.uploaded == 0;
  if (state_.ready && !needed && recordedFrame_ <= completed) releaseScratch();
}

Status Tables::noteFrame() {
  if (recordedFrame_ == device_.submitting()) return Status::Ok;
  for (size_t i = 0; i < images_.size(); ++i) imagesBefore_[i] = images_[i];
  stateBefore_ = state_;
  keptFrame_ = device_.submitting();
  recordedBefore_ = recordedFrame_;
  recordedFrame_ = keptFrame_;
  return Status::Ok;
}

void Tables::frameAbandoned(uint64_t frame) {
  if (recordedFrame_ < frame) return;
  if (keptFrame_ == frame) {
    state_ = stateBefore_;
    for (size_t i = 0; i < images_.size(); ++i)
      static_cast<engine::ImageTrack&>(images_[i]) = imagesBefore_[i];
    recordedFrame_ = recordedBefore_;
    keptFrame_ = 0;
    return;
  }
  // Complete before that frame, which can only have recorded readbacks: they keep the images.
  if (state_.ready && state_.readyFrame < frame) return;
  // Later slices depend on results that are missing now. Their commands may still execute.
  state_ = {};
  recordedFrame_ = keptFrame_ = 0;
  for (engine::Image& image : images_) image.state.layout = VK_IMAGE_LAYOUT_UNDEFINED;
}

void Tables::releaseScratch() {
  if (scratchReleased_) return;
  scratchReleased_ = true;
  for (size_t i = 0; i < images_.size(); ++i)
    if (!graph_.images[i].persistent) engine::deferImage(device_, 0, &images_[i]);
  engine::deferBlock(device_, 0, &scratchBlock_);
}

uint32_t Tables::imageOf(TableId id) const {
  const bool had = id < kTableIdCount && (!isOrderTable(id) || (desc_.keepOrders && bakes_));
  return had ? graph_.imageOf(id) : kNoImage;
}

Status Tables::missing(TableId id) const {
  const bool known = id < kTableIdCount;
  const TableKind kind = known ? kTableKinds[id] : TableKind{nameOf(id), true, true};
  const bool hasIt = desc_.solver == Solver::Moments    ? kind.moments
                     : desc_.solver == Solver::Standard ? kind.standard
                                                        : false;  // The models' have no id.
  const char* needs = !known   ? "one of the enumeration"
                      : !hasIt ? (kind.moments ? "Solver::Moments" : "Solver::Standard")
                      : isOrderTable(id) && !desc_.keepOrders ? "TableDesc::keepOrders"
                      : desc_.solver == Solver::Moments       ? "effects that these tables disable"
                                                              : "MieStorage::Full";
  return device_.fail(Status::Unsupported, VK_SUCCESS,
                      "These tables have no table %s: it needs %s.", kind.name, needs);
}

ImageInfo Tables::imageInfo(TableId id) const {
  ImageInfo info;
  const uint32_t index = imageOf(id);
  if (index == kNoImage) return info;
  const tables::BakeImage& graph = graph_.images[index];
  const engine::Image& image = images_[index];
  info.name = nameOf(id);
  info.image = image.handle;
  info.view = image.view;
  info.format = graph.format;
  info.extent = graph.extent;
  info.bytes = tables::bytesOf(graph);
  info.layout = image.state.layout;
  info.stage = image.state.stage;
  info.access = image.state.access;
  return info;
}

void Tables::info(TablesInfo* out) const {
  *out = {};
  out->state = state();
  out->desc = desc_;
  out->setLayout = resources_.tableLayout();
  out->set = tableSet_;
  for (uint32_t i = 0; i < kTableIdCount; ++i) out->images[i] = imageInfo(static_cast<TableId>(i));
}

Tables::HostCopy Tables::hostCopy(TableId id) const {
  if (id > kTableSource || hostCopies_[id].handle == VK_NULL_HANDLE) return {};
  const tables::BakeImage& graph = graph_.images[imageOf(id)];
  return {hostCopies_[id].mapped, graph.extent, graph.format};
}

// Order tables can be read between the pass that finished them and the next one.
uint32_t Tables::readableImage(TableId id) const {
  if (!isOrderTable(id)) return state_.ready ? graph_.imageOf(id) : kNoImage;
  if (state_.row != 0 || state_.pass == 0) return kNoImage;
  return graph_.imageAfter(graph_.passes[state_.pass - 1], id);
}

Status Tables::recordReadback(VkCommandBuffer commands, TableId id, VkBuffer buffer,
                              VkDeviceSize offset) {
  if (imageOf(id) == kNoImage) return missing(id);
  if (buffer == VK_NULL_HANDLE || offset % 16 != 0) {
    return device_.fail(Status::InvalidArgument, VK_SUCCESS,
                        "The readback of table %s got %s buffer and offset %llu, but needs a "
                        "buffer and a multiple of 16.",
                        nameOf(id), buffer == VK_NULL_HANDLE ? "a null" : "a",
                        static_cast<unsigned long long>(offset));
  }
  const uint32_t index = readableImage(id);
  if (index == kNoImage) return Status::NotReady;
  Status status = noteFrame();
  if (status != Status::Ok) return status;
  engine::Image& image = images_[index];
  engine::Barriers barriers;
  barriers.image(image, engine::kTransferSource);
  status = barriers.record(device_, commands);
  if (status != Status::Ok) return status;
  copyToBuffer(commands, image, buffer, offset);
  barriers.image(image, readable());
  barriers.memory(VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                  VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
  return barriers.record(device_, commands);
}

Status Tables::recordUpload(VkCommandBuffer commands, TableId id, VkBuffer buffer,
                            VkDeviceSize offset) {
  if (imageOf(id) == kNoImage) return missing(id);
  if (isOrderTable(id) || buffer == VK_NULL_HANDLE || offset % 16 != 0 || state_.unitsDone != 0) {
    return device_.fail(Status::InvalidArgument, VK_SUCCESS,
                        "The upload of table %s (buffer %s, offset %llu, %s) needs a final table, "
                        "a buffer, an offset that is a multiple of 16, and tables without a bake.",
                        nameOf(id), buffer == VK_NULL_HANDLE ? "null" : "given",
                        static_cast<unsigned long long>(offset),
                        state_.unitsDone != 0 ? "bake begun" : "no bake begun");
  }
  Status status = noteFrame();
  if (status != Status::Ok) return status;
  const uint32_t index = imageOf(id);
  engine::Image& image = images_[index];
  engine::Barriers barriers;
  barriers.discard(image, engine::kTransferDestination);
  status = barriers.record(device_, commands);
  if (status != Status::Ok) return status;
  const VkBufferImageCopy copy = wholeCopy(image, offset);
  device_.vk().CmdCopyBufferToImage(commands, buffer, image.handle,
                                    VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
  barriers.image(image, readable());
  status = barriers.record(device_, commands);
  if (status != Status::Ok) return status;
  state_.uploaded |= 1u << index;
  uint32_t needed = 0;
  for (uint32_t i = 0; i < images_.size(); ++i)
    if (graph_.images[i].persistent) needed |= 1u << i;
  // A table that is uploaded once more is copied to the host once more.
  return state_.uploaded == needed ? finish(commands) : Status::Ok;
}

Status Tables::assertReadable() const {
  if (!state_.ready) return Status::NotReady;
  for (size_t i = 0; i < images_.size(); ++i) {
    if (!graph_.images[i].persistent) continue;
    const Status status =
        engine::assertLayout(device_, images_[i], VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    if (status != Status::Ok) return status;
  }
  return Status::Ok;
}

}  // namespace v1_0
}  // namespace alpenglow
