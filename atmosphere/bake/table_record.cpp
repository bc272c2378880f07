// What Tables record: slices of the bake, readback and upload.
#include <algorithm>
#include <new>

#include "atmosphere/bake/table_set.h"

namespace alpenglow {
inline namespace v1 {
namespace {

using bake::isOrderTable;
using bake::kNoImage;

// Where host shaders and our own sample the finished tables.
constexpr ImageState kReadable = {
    VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
    VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
    VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};

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

uint64_t texelBytes(VkFormat format) { return format == VK_FORMAT_R32G32B32A32_SFLOAT ? 16 : 8; }

}  // namespace

Status Tables::recordBake(VkCommandBuffer commands, uint64_t budget,
                          BakeProgress* progress) {
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
  const uint32_t passCount = static_cast<uint32_t>(plan_.passes.size());
  BakeProgress now;
  now.passCount = passCount;
  now.unitsTotal = unitsTotal_;
  if (state_.pass < passCount) {
    const bake::Pass& pass = plan_.passes[state_.pass];
    const bake::Stage& stage = plan_.stages[pass.stage];
    const uint64_t tilesLeft = (stage.rows - state_.row + bake::kTileRows - 1) / bake::kTileRows;
    const uint64_t tilesWanted =
        budget / std::max<uint64_t>(stage.unitsPerRow() * bake::kTileRows, 1);
    const uint64_t tiles = std::clamp<uint64_t>(budget == 0 ? tilesLeft : tilesWanted, 1, 65535);
    const uint32_t endRow = static_cast<uint32_t>(
        std::min<uint64_t>(stage.rows, state_.row + tiles * bake::kTileRows));
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

Status Tables::recordPass(VkCommandBuffer commands, const bake::Pass& pass, uint32_t firstRow,
                          uint32_t endRow) {
  const engine::Dispatch& vk = device_.vk();
  const bake::Stage& stage = plan_.stages[pass.stage];
  const StageObjects& objects = stages_[pass.stage];
  engine::Barriers barriers;
  for (const bake::StageInput& input : stage.inputs)
    barriers.image(images_[input.image], engine::kComputeSampled);
  for (const bake::StageOutput& output : stage.outputs) {
    // An image stands for others that aren't there; once is enough.
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
  const bake::TileConstants tile = {firstRow, endRow, stage.width, stage.height};
  vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, objects.pipeline);
  vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, resources_.pipelineLayout(), 0,
                           2, sets, 0, nullptr);
  vk.CmdPushConstants(commands, resources_.pipelineLayout(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                      sizeof tile, &tile);
  vk.CmdDispatch(commands, (stage.width + 7) / 8,
                 (endRow - firstRow + bake::kTileRows - 1) / bake::kTileRows, 1);
  device_.endLabel(commands);
  ++device_.counters().dispatches;
  return Status::Ok;
}

Status Tables::makeReadable(VkCommandBuffer commands) {
  engine::Barriers barriers;
  for (size_t i = 0; i < images_.size(); ++i)
    if (plan_.images[i].persistent) barriers.image(images_[i], kReadable);
  return barriers.record(device_, commands);
}

Status Tables::finish(VkCommandBuffer commands) {
  const Status status = makeReadable(commands);
  if (status != Status::Ok) return status;
  state_.ready = true;
  return Status::Ok;
}

// Only once the last frame has completed: an abandoned one would need it again.
void Tables::frameCompleted(uint64_t completed) {
  const bool needed = desc_.keepOrders && state_.uploaded == 0;
  if (state_.ready && !needed && recordedFrame_ <= completed) releaseScratch();
}

Status Tables::noteFrame() {
  if (recordedFrame_ == device_.submitting()) return Status::Ok;
  try {
    imagesBefore_.resize(images_.size());
  } catch (const std::bad_alloc&) {
    return device_.fail(Status::OutOfHostMemory, VK_SUCCESS,
                        "Recording commands for tables found no host memory.");
  }
  for (size_t i = 0; i < images_.size(); ++i) imagesBefore_[i] = images_[i];
  stateBefore_ = state_;
  recordedFrame_ = device_.submitting();
  return Status::Ok;
}

void Tables::frameAbandoned(uint64_t frame) {
  if (recordedFrame_ < frame) return;
  if (recordedFrame_ == frame) {
    state_ = stateBefore_;
    for (size_t i = 0; i < images_.size(); ++i) static_cast<engine::ImageTrack&>(images_[i]) = imagesBefore_[i];
    --recordedFrame_;
    return;
  }
  // Later slices stand on what is missing now.
  const bool finished = scratchReleased_;  // Then frame is a readback's, and the tables are whole.
  if (finished) return;
  state_ = {};
  for (engine::Image& image : images_) static_cast<engine::ImageTrack&>(image) = {};
}

void Tables::releaseScratch() {
  if (scratchReleased_) return;
  scratchReleased_ = true;
  for (size_t i = 0; i < images_.size(); ++i)
    if (!plan_.images[i].persistent) engine::deferImage(device_, 0, &images_[i]);
  engine::deferBlock(device_, 0, &scratchBlock_);
}

uint32_t Tables::imageOf(TableId id) const {
  return isOrderTable(id) && !(desc_.keepOrders && bakes_) ? kNoImage : plan_.imageOf(id);
}

Status Tables::missing(TableId id) const {
  const auto index = static_cast<uint32_t>(id);
  const bool known = index < kTableIdCount;
  const TableKind kind =
      known ? kTableKinds[index] : TableKind{"of an unknown TableId", true, true};
  const bool hasIt = desc_.solver == Solver::Moments    ? kind.moments
                     : desc_.solver == Solver::Standard ? kind.standard
                                                        : false;  // The models' have no id.
  const char* needs = !known   ? "one of the enumeration"
                      : !hasIt ? (kind.moments ? "Solver::Moments" : "Solver::Standard")
                      : isOrderTable(id) && !desc_.keepOrders ? "TableDesc::keepOrders"
                      : desc_.solver == Solver::Moments ? "effects that these tables are without"
                                                        : "MieStorage::Full";
  return device_.fail(Status::Unsupported, VK_SUCCESS,
                      "These tables have no table %s: it needs %s.", kind.name, needs);
}

Status Tables::info(TableId id, TableInfo* out) const {
  *out = {};
  const uint32_t image = static_cast<uint32_t>(id) < kTableIdCount ? imageOf(id) : kNoImage;
  if (image == kNoImage) return missing(id);
  const bake::PlanImage& plan = plan_.images[image];
  out->name = kTableKinds[static_cast<uint32_t>(id)].name;
  out->width = plan.extent.width;
  out->height = plan.extent.height;
  out->depth = plan.extent.depth;
  out->format = plan.format;
  out->bytes = uint64_t(out->width) * out->height * out->depth * texelBytes(out->format);
  return Status::Ok;
}

// Order tables can be read between the pass that finished them and the next one.
uint32_t Tables::readableImage(TableId id) const {
  if (!isOrderTable(id)) return state_.ready ? plan_.imageOf(id) : kNoImage;
  if (state_.row != 0 || state_.pass == 0) return kNoImage;
  return plan_.imageAfter(plan_.passes[state_.pass - 1], id);
}

Status Tables::notReadable(TableId id) const {
  const char* name = kTableKinds[static_cast<uint32_t>(id)].name;
  if (!isOrderTable(id)) {
    return device_.fail(Status::NotReady, VK_SUCCESS,
                        "The table %s can be read back only when the bake is done or the tables "
                        "are uploaded.",
                        name);
  }
  const char* first = "";
  for (size_t i = plan_.passes.size(); i-- > 0;)
    if (plan_.imageAfter(plan_.passes[i], id) != kNoImage) first = plan_.passes[i].name;
  return device_.fail(Status::NotReady, VK_SUCCESS,
                      "The table %s can be read back only right after the pass that finishes it "
                      "for its order, the first time after \"%s\".",
                      name, first);
}

Status Tables::recordReadback(VkCommandBuffer commands, TableId id, VkBuffer buffer,
                              VkDeviceSize offset) {
  TableInfo table;
  Status status = info(id, &table);
  if (status != Status::Ok) return status;
  if (buffer == VK_NULL_HANDLE || offset % 16 != 0) {
    return device_.fail(Status::InvalidArgument, VK_SUCCESS,
                        "The readback of table %s got %s buffer and offset %llu, but needs a "
                        "buffer and a multiple of 16.",
                        table.name, buffer == VK_NULL_HANDLE ? "a null" : "a",
                        static_cast<unsigned long long>(offset));
  }
  const uint32_t index = readableImage(id);
  if (index == kNoImage) return notReadable(id);
  status = noteFrame();
  if (status != Status::Ok) return status;
  engine::Image& image = images_[index];
  engine::Barriers barriers;
  barriers.image(image, engine::kTransferSource);
  status = barriers.record(device_, commands);
  if (status != Status::Ok) return status;
  const VkBufferImageCopy copy = wholeCopy(image, offset);
  device_.vk().CmdCopyImageToBuffer(commands, image.handle, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                    buffer, 1, &copy);
  barriers.image(image, kReadable);
  barriers.memory(VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                  VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
  return barriers.record(device_, commands);
}

Status Tables::recordUpload(VkCommandBuffer commands, TableId id,
                            VkBuffer buffer, VkDeviceSize offset) {
  TableInfo table;
  Status status = info(id, &table);
  if (status != Status::Ok) return status;
  if (isOrderTable(id) || buffer == VK_NULL_HANDLE || offset % 16 != 0 || state_.unitsDone != 0) {
    return device_.fail(Status::InvalidArgument, VK_SUCCESS,
                        "The upload of table %s (buffer %s, offset %llu, %s) needs a final table, "
                        "a buffer, an offset that is a multiple of 16, and tables without a bake.",
                        table.name, buffer == VK_NULL_HANDLE ? "null" : "given",
                        static_cast<unsigned long long>(offset),
                        state_.unitsDone != 0 ? "bake begun" : "no bake begun");
  }
  status = noteFrame();
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
  barriers.image(image, kReadable);
  status = barriers.record(device_, commands);
  if (status != Status::Ok) return status;
  state_.uploaded |= 1u << index;
  uint32_t needed = 0;
  for (uint32_t i = 0; i < images_.size(); ++i)
    if (plan_.images[i].persistent) needed |= 1u << i;
  if (state_.uploaded == needed && !state_.ready) {
    state_.ready = true;
  }
  return Status::Ok;
}

Status Tables::assertReadable() const {
  if (!state_.ready) {
    return device_.fail(Status::NotReady, VK_SUCCESS,
                        "The tables are not ready: %llu of %llu work units are baked.",
                        static_cast<unsigned long long>(state_.unitsDone),
                        static_cast<unsigned long long>(unitsTotal_));
  }
  for (size_t i = 0; i < images_.size(); ++i) {
    if (!plan_.images[i].persistent) continue;
    const Status status =
        engine::assertLayout(device_, images_[i], VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    if (status != Status::Ok) return status;
  }
  return Status::Ok;
}

}  // namespace v1
}  // namespace alpenglow
