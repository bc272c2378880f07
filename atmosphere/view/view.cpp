#include "atmosphere/view/view.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "atmosphere/parameters/solvers.h"
#include "atmosphere/passes/aerial_perspective_set.h"

namespace alpenglow {
inline namespace v1_0 {
namespace {

passes::LightShaftSet lightShaftSetOf(const passes::LightShaftPass& pass) {
  if (!pass.made()) return {};
  const LightShaftSettings& desc = pass.desc();
  return {pass.setLayout(), VK_NULL_HANDLE, passes::methodIndex(desc.method), desc.stepCount,
          static_cast<float>(desc.multipleLoss)};
}

/// As this frame's record functions leave it, which the host calls after it has this.
ImageInfo infoOf(const engine::Image& image) {
  ImageInfo info;
  info.name = image.name;
  info.image = image.handle;
  info.view = image.view;
  info.format = image.desc.format;
  info.extent = image.desc.extent;
  info.bytes = image.bytes;
  info.layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
  info.stage = image.writeStage;
  info.access = image.writeAccess;
  return info;
}

}  // namespace

View::View(tables::Resources& resources, const Tables& tables, const ViewDesc& desc)
    : FrameObject(resources.device().frames()),
      resources_(resources),
      device_(resources.device()),
      desc_(view::resolve(tables.desc(), desc)),
      tables_(&tables),
      tablesId_(tables.id()),
      shape_(tables.desc()),
      skyLut_(resources),
      aerialLut_(resources),
      lightShafts_(resources),
      skyPass_(device_),
      aerialPass_(device_),
      pictureSets_(device_) {}

Status View::create(tables::Resources& resources, const Tables& tables, const ViewDesc& desc,
                    View** out) {
  *out = nullptr;
  auto* view = new (std::nothrow) View(resources, tables, desc);
  if (view == nullptr) {
    return resources.device().fail(Status::OutOfHostMemory, VK_SUCCESS,
                                   "A view found no host memory.");
  }
  const Status status = view->make(tables);
  if (status != Status::Ok) {
    destroy(view, 0);  // Nothing was recorded with it: frame 0 has always completed.
    return status;
  }
  *out = view;
  return Status::Ok;
}

void View::destroy(View* view, uint64_t frame) {
  engine::Device& device = view->device_;
  engine::DeletionQueue& deletions = device.deletions();
  view->skyPass_.destroy(frame);
  view->aerialPass_.destroy(frame);
  deletions.defer(frame, VK_OBJECT_TYPE_PIPELINE_LAYOUT, engine::handleNumber(view->layout_));
  view->pictureSets_.destroy(frame);
  deletions.defer(frame, VK_OBJECT_TYPE_DESCRIPTOR_POOL, engine::handleNumber(view->aerialPool_));
  deletions.defer(frame, VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT,
                  engine::handleNumber(view->aerialLayout_));
  view->lightShafts_.destroy(frame);
  view->aerialLut_.destroy(frame);
  view->skyLut_.destroy(frame);
  delete view;
  deletions.collect(device.completed());
}

Status View::make(const Tables& tables) {
  const PictureDesc& picture = desc_.picture;
  Status status = Status::Ok;
  if (picture.skyLut) status = skyLut_.make(tables.desc(), picture.disabledEffects, desc_.readers);
  if (status == Status::Ok && picture.aerialLut)
    status = aerialLut_.make(picture.disabledEffects, desc_.readers);
  if (status == Status::Ok && desc_.hasLightShafts)
    status = lightShafts_.make(desc_.shafts, resources_.setStages());
  if (status == Status::Ok) status = makeSets();
  return status == Status::Ok ? makePipelines() : status;
}

// Set 1: the albedo map at binding 0, the sky-view LUT at 1 and 2, the scene's depth at 3; what
// there is of it. Set 2 is the aerial-perspective LUT's, set 3 the light shafts'.
Status View::makeSets() {
  const PictureDesc& picture = desc_.picture;
  VkDescriptorSetLayoutBinding bindings[4];
  uint32_t count = 0;
  const auto add = [&](uint32_t binding) {
    bindings[count++] = {binding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1,
                         resources_.setStages(), nullptr};
  };
  if (picture.groundAlbedo.view != VK_NULL_HANDLE) add(0);
  if (picture.skyLut) {
    add(1);
    add(2);
  }
  if (picture.aerial) add(3);
  hasPictureSet_ = count > 0;
  Status status =
      hasPictureSet_ ? pictureSets_.make(bindings, count, "Alpenglow view") : Status::Ok;
  if (status != Status::Ok || !picture.aerial) return status;
  status =
      passes::createAerialPerspectiveSetLayout(device_, resources_.setStages(), &aerialLayout_);
  if (status != Status::Ok || !picture.aerialLut) return status;
  return passes::createAerialPerspectiveSet(resources_, aerialLut_, aerialLayout_, &aerialPool_,
                                            &aerialSet_);
}

Status View::makePipelines() {
  const PictureDesc& picture = desc_.picture;
  const VkDescriptorSetLayout sets[] = {resources_.tableLayout(), pictureSets_.layout(),
                                        aerialLayout_, lightShafts_.setLayout()};
  const uint32_t count = desc_.hasLightShafts ? 4 : picture.aerial ? 3 : hasPictureSet_ ? 2 : 1;
  const VkPushConstantRange range = {VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(passes::SkyConstants)};
  Status status =
      engine::createPipelineLayout(device_, sets, count, &range, 1, "Alpenglow sky", &layout_);
  if (status != Status::Ok) return status;
  const passes::LightShaftSet shafts = lightShaftSetOf(lightShafts_);
  status = skyPass_.make(picture, shafts, picture.skyLut ? &skyLut_ : nullptr, layout_);
  if (status == Status::Ok && picture.aerial) status = aerialPass_.make(picture, shafts, layout_);
  return status;
}

Status View::checkTables(const Tables& tables) const {
  const TableDesc& desc = tables.desc();
  if (&tables.resources() != &resources_) {
    return device_.fail(Status::InvalidArgument, VK_SUCCESS,
                        "FrameDesc::tables are of another context, but a view draws with tables of "
                        "its own.");
  }
  const bool standard = desc.solver == Solver::Standard;
  const char* other = desc.solver != shape_.solver                     ? "solver"
                      : desc.mie != shape_.mie                         ? "MieStorage"
                      : desc.disabledEffects != shape_.disabledEffects ? "disabledEffects"
                      : standard && skyLut_.made() &&
                              (desc.sizes.scatteringMu != shape_.sizes.scatteringMu ||
                               desc.sizes.scatteringNu != shape_.sizes.scatteringNu)
                          ? "scatteringMu or scatteringNu"
                          : nullptr;
  if (other == nullptr) return Status::Ok;
  return device_.fail(Status::InvalidArgument, VK_SUCCESS,
                      "FrameDesc::tables differ in %s from the tables that the view was created "
                      "with: create a view for these.",
                      other);
}

Status View::beginFrame(const FrameDesc& desc, FrameWork* work) {
  if (work != nullptr) *work = {};
  frame_.number = device_.submitting();
  frame_.valid = false;
  frame_.mapRecorded = frame_.lightShaftsRecorded = false;
  view::Warnings::checkAdvanced(device_);
  const Status status = takeFrame(desc);
  if (status != Status::Ok) return status;
  frame_.valid = true;
  if (work != nullptr) answer(work);
  return Status::Ok;
}

Status View::takeFrame(const FrameDesc& desc) {
  const PictureDesc& picture = desc_.picture;
  const Tables* tables = desc.tables != nullptr ? desc.tables : tables_;
  if (tables == nullptr) {
    return device_.fail(Status::InvalidArgument, VK_SUCCESS,
                        "FrameDesc::tables is null, but the tables of createView are destroyed.");
  }
  Status status = checkTables(*tables);
  if (status == Status::Ok) status = view::checkLater(device_, desc);
  if (status == Status::Ok) status = view::checkWorld(device_, desc.world);
  if (status != Status::Ok) return status;
  if (!(desc.lights[0].dimming >= 0.0 && desc.lights[0].dimming <= 1.0)) {
    return device_.fail(Status::InvalidArgument, VK_SUCCESS,
                        "Light::dimming is %g, but must be from 0 to 1.", desc.lights[0].dimming);
  }
  const Parameters& parameters = tables->parameters();
  frame_.tables = tables;
  frame_.sceneDepth = desc.sceneDepth;
  if (frame_.sceneDepth.layout == VK_IMAGE_LAYOUT_UNDEFINED)
    frame_.sceneDepth.layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
  const VkExtent2D scene = desc.sceneDepth.extent;
  FrameState& state = frame_.state;
  state = view::frameState(desc, picture.projection, tables->irradiance(), scene);
  status = passes::checkDraw(device_, picture.projection, state);
  if (status == Status::Ok && picture.aerial) {
    status = passes::checkDepthRange(device_, picture.projection, state.depth);
    if (status == Status::Ok &&
        (desc.sceneDepth.view == VK_NULL_HANDLE || scene.width == 0 || scene.height == 0)) {
      status = device_.fail(Status::InvalidArgument, VK_SUCCESS,
                            "FrameDesc::sceneDepth has %s view and %u x %u pixels, but a view with "
                            "aerial perspective needs a view and its extent.",
                            desc.sceneDepth.view == VK_NULL_HANDLE ? "no" : "a", scene.width,
                            scene.height);
    }
  }
  if (status != Status::Ok) return status;
  warnings_.check(device_, parameters, state, picture.colorFormat);
  if (!tables->ready()) return Status::NotReady;
  status = tables->assertReadable();
  if (status == Status::Ok) status = passes::checkDrawnEffects(device_, parameters, picture, state);
  if (status != Status::Ok) return status;
  frame_.parts = passes::cut(parameters, picture, state);
  status = passes::checkPartition(device_, picture, frame_.parts);
  if (status == Status::Ok && desc_.hasLightShafts) {
    frame_.casters = view::casterSet(desc, state);
    frame_.casters.outsideReported = warnings_.outsideCasters();
    frame_.casters.lit = desc.casters.draw != nullptr &&
                         passes::sunReaches(parameters, frame_.casters.bounds, state.sun.direction);
    status = passes::checkCasters(device_, frame_.casters);
    if (status == Status::Ok) status = passes::checkViewport(device_, scene, state);
    if (status == Status::Ok) status = lightShafts_.resize(scene);
    // A direction that differs by rounding alone is that of the map.
    if (lightShafts_.mapped() && lightShafts_.map().current(state.sun.direction, frame_.casters))
      std::copy_n(lightShafts_.map().sun(), 3, state.sun.direction);
  }
  if (status == Status::Ok) status = prepareSets();
  if (status != Status::Ok) return status;
  frame_.skyConstants = passes::makeSkyConstants(parameters, picture, state);
  if (picture.aerial)
    frame_.aerialConstants = passes::makeAerialPerspectiveConstants(parameters, picture, state);
  return Status::Ok;
}

Status View::prepareSets() {
  const PictureDesc& picture = desc_.picture;
  VkDescriptorSet set = fixedSet_;
  if (hasPictureSet_ && set == VK_NULL_HANDLE) {
    const Status status = pictureSets_.next(&set);
    if (status != Status::Ok) return status;
    engine::DescriptorWriter writer(set);
    if (picture.groundAlbedo.view != VK_NULL_HANDLE) {
      writer.sampledImage(0, picture.groundAlbedo.view, picture.groundAlbedo.sampler,
                          picture.groundAlbedo.layout);
    }
    if (picture.skyLut) {
      writer.sampledImage(1, skyLut_.image().view, resources_.sampler())
          .sampledImage(2, skyLut_.mieImage().view, resources_.sampler());
    }
    if (picture.aerial) {
      writer.sampledImage(3, frame_.sceneDepth.view, resources_.nearestSampler(),
                          frame_.sceneDepth.layout);
    }
    const Status written = writer.flush(device_);
    if (written != Status::Ok) return written;
    if (!picture.aerial) fixedSet_ = set;  // Nothing in it changes.
  }
  frame_.sets.sets[kViewSetTables] = frame_.tables->descriptorSet();
  frame_.sets.sets[kViewSetSky] = set;
  frame_.sets.sets[kViewSetAerialPerspective] = aerialSet_;
  frame_.sets.sets[kViewSetLightShafts] = lightShafts_.set();
  return Status::Ok;
}

bool View::skyFromLut() const {
  return desc_.picture.skyLut && passes::SkyViewLut::possible(*frame_.tables, frame_.state);
}

RecordFlags View::needed() const {
  RecordFlags flags = kRecordSky;
  const bool sky = skyFromLut() && !skyLut_.current(*frame_.tables, frame_.state);
  const bool aerial = desc_.picture.aerialLut && !aerialLut_.current(*frame_.tables, frame_.state);
  if (sky || aerial) flags |= kRecordLuts;
  if (desc_.picture.aerial) flags |= kRecordAerialPerspective;
  if (!desc_.hasLightShafts) return flags;
  if (lightShafts_.mapped() && frame_.casters.lit &&
      !lightShafts_.map().current(frame_.state.sun.direction, frame_.casters))
    flags |= kRecordShadowMap;
  return flags | kRecordLightShafts;
}

Status View::checkBegun(const char* call) const {
  if (frame_.number != device_.submitting()) {
    return device_.fail(Status::InvalidArgument, VK_SUCCESS,
                        "%s was called without beginFrame of this view in frame %llu.", call,
                        static_cast<unsigned long long>(device_.submitting()));
  }
  return frame_.valid ? Status::Ok : Status::NotReady;
}

Status View::recordLuts(VkCommandBuffer commands) {
  Status status = checkBegun("recordLuts");
  if (status != Status::Ok) return status;
  if (!skyFromLut() && !desc_.picture.aerialLut) return Status::Ok;
  if ((needed() & kRecordLuts) == 0) {
    ++device_.counters().lutsSkipped;
    return Status::Ok;
  }
  if (skyFromLut()) status = skyLut_.record(commands, *frame_.tables, frame_.state);
  if (status == Status::Ok && desc_.picture.aerialLut)
    status = aerialLut_.record(commands, *frame_.tables, frame_.state);
  if (status == Status::Ok) ++device_.counters().lutUpdates;
  return status;
}

Status View::recordShadowMap(VkCommandBuffer commands) {
  Status status = checkBegun("recordShadowMap");
  if (status != Status::Ok || !desc_.hasLightShafts || !lightShafts_.mapped()) return status;
  if ((needed() & kRecordShadowMap) == 0) {
    ++device_.counters().shadowMapsSkipped;
    return Status::Ok;
  }
  ++device_.counters().shadowMapUpdates;
  status = lightShafts_.recordShadowMap(commands, frame_.state.sun.direction, frame_.casters);
  frame_.mapRecorded = status == Status::Ok;
  return status;
}

Status View::recordLightShafts(VkCommandBuffer commands) {
  Status status = checkBegun("recordLightShafts");
  if (status != Status::Ok || !desc_.hasLightShafts) return status;
  if (!frame_.mapRecorded && (needed() & kRecordShadowMap) != 0) {
    return device_.fail(Status::InvalidArgument, VK_SUCCESS,
                        "recordLightShafts needs the shadow map of this frame, but recordShadowMap "
                        "was not called after beginFrame.");
  }
  VkDescriptorSet lut = VK_NULL_HANDLE;
  if (desc_.picture.aerialLut) {
    if (!aerialLut_.current(*frame_.tables, frame_.state)) {
      return device_.fail(Status::InvalidArgument, VK_SUCCESS,
                          "recordLightShafts needs the LUTs of this frame, but recordLuts was not "
                          "called after beginFrame.");
    }
    lut = aerialSet_;
  }
  status = lightShafts_.record(commands, *frame_.tables, frame_.state, frame_.sceneDepth,
                               frame_.casters, lut);
  frame_.lightShaftsRecorded = status == Status::Ok;
  return status;
}

Status View::recordAerialPerspective(VkCommandBuffer commands) {
  const Status status = checkBegun("recordAerialPerspective");
  if (status != Status::Ok || !desc_.picture.aerial) return status;
  const bool lut = desc_.picture.aerialLut;
  if (lut && !aerialLut_.current(*frame_.tables, frame_.state)) {
    return device_.fail(Status::InvalidArgument, VK_SUCCESS,
                        "recordAerialPerspective needs the LUTs of this frame, but recordLuts was "
                        "not called after beginFrame.");
  }
  if (desc_.hasLightShafts && !frame_.lightShaftsRecorded) {
    return device_.fail(Status::InvalidArgument, VK_SUCCESS,
                        "recordAerialPerspective needs the light shafts of this frame, but "
                        "recordLightShafts was not called after beginFrame.");
  }
  aerialPass_.record(commands, frame_.aerialConstants, frame_.sets, frame_.state.viewport, lut);
  return Status::Ok;
}

Status View::recordSky(VkCommandBuffer commands) {
  Status status = checkBegun("recordSky");
  if (status != Status::Ok) return status;
  const bool lut = skyFromLut();
  if (lut && !skyLut_.current(*frame_.tables, frame_.state)) {
    return device_.fail(Status::InvalidArgument, VK_SUCCESS,
                        "recordSky needs the sky-view LUT of this frame, but recordLuts was not "
                        "called after beginFrame.");
  }
  if (desc_.hasLightShafts && !frame_.lightShaftsRecorded) {
    return device_.fail(Status::InvalidArgument, VK_SUCCESS,
                        "recordSky needs the light shafts of this frame, but recordLightShafts was "
                        "not called after beginFrame.");
  }
  skyPass_.record(commands, frame_.skyConstants, frame_.sets, frame_.state.viewport, frame_.parts,
                  lut);
  return Status::Ok;
}

void View::frameAbandoned(uint64_t frame) {
  skyLut_.lut().abandon(frame);
  aerialLut_.lut().abandon(frame);
  lightShafts_.abandon(frame);
}

void View::objectDestroyed(const FrameObject* object) {
  if (object == frame_.tables) frame_.valid = false;
  if (object == tables_) tables_ = nullptr;
}

void View::info(ViewInfo* out) const {
  *out = {};
  out->setLayouts[kViewSetTables] = resources_.tableLayout();
  out->setLayouts[kViewSetSky] = pictureSets_.layout();
  out->setLayouts[kViewSetAerialPerspective] = aerialLayout_;
  out->setLayouts[kViewSetLightShafts] = lightShafts_.setLayout();
}

void View::answer(FrameWork* work) const {
  const Parameters& parameters = frame_.tables->parameters();
  const FrameState& state = frame_.state;
  work->record = needed();
  for (uint32_t i = 0; i < frame_.parts.count; ++i) {
    const passes::Visible& seen = frame_.parts.parts[i].visible;
    if (seen.atmosphere) work->visible |= kVisibleSky;
    if (seen.ground) work->visible |= kVisibleGround;
    if (seen.disc) work->visible |= kVisibleSun;
    if (!seen.atmosphere) work->visible |= kVisibleSpace;
  }
  if (desc_.picture.aerial) work->visible |= kVisibleScene;
  work->altitude_m = passes::cameraAltitude(parameters, state.camera);
  const Spectrum light = passes::sunlight(parameters, state);
  const double scale = state.radianceScale == 0.0 ? 1.0 : state.radianceScale;
  constexpr double kLuminance[] = {0.2126, 0.7152, 0.0722};  // Rec.709.
  for (uint32_t i = 0; i < kSpectrumSize; ++i) {
    work->color[0][i] = light[i] * scale;
    work->illuminance[0] += kLuminance[i] * light[i];
  }
  std::copy_n(frame_.sets.sets, kViewSetCount, work->sets);
  ImageInfo* images = work->images;
  if (skyLut_.made()) {
    images[kViewSkyLut] = infoOf(skyLut_.image());
    if (skyLut_.lut().count() > 1) images[kViewSkyLutMie] = infoOf(skyLut_.mieImage());
  }
  if (aerialLut_.made()) {
    for (uint32_t i = 0; i < passes::AerialPerspectiveLut::kImages; ++i)
      images[kViewAerialPerspectiveLut0 + i] = infoOf(aerialLut_.image(i));
  }
  if (desc_.hasLightShafts && lightShafts_.mapped())
    images[kViewShadowMap] = infoOf(lightShafts_.map().depth());
  if (lightShafts_.targetCount() > 0) images[kViewLightShafts] = infoOf(lightShafts_.target(0));
  if (!desc_.picture.aerial) return;
  ImageInfo& depth = images[kViewSceneDepth];
  depth.name = "scene depth";
  depth.view = frame_.sceneDepth.view;
  depth.format = desc_.picture.sceneDepthFormat;
  depth.extent = {frame_.sceneDepth.extent.width, frame_.sceneDepth.extent.height, 1};
  depth.layout = frame_.sceneDepth.layout;
  depth.stage =
      VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT;
  depth.access =
      VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT;
}

}  // namespace v1_0
}  // namespace alpenglow
