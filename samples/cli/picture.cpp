#include "picture.h"

#include "scene_plan.h"

namespace alpenglow::cli {
namespace {

struct ViewDeleter {
  Session* session = nullptr;
  void operator()(View* view) const { destroyView(view, session->device().frame()); }
};
using ViewPointer = std::unique_ptr<View, ViewDeleter>;

void recordPicture(Session* session, VkCommandBuffer commands, const headless::Image& target,
                   View* view, const Tables* tables, const SkyDraw& draw) {
  const FrameInfo frame = session->device().frame();
  const samples::Gpu gpu = session->gpu();
  session->check(recordSkySlice(view, commands, frame, tables, draw));
  gpu.barrier(commands, target, samples::kUndefined, samples::kColorDrawn);
  gpu.render(commands, target, draw.viewport, VK_ATTACHMENT_LOAD_OP_CLEAR, nullptr,
             [&] { session->check(recordSky(view, commands, frame, tables, draw)); });
  gpu.barrier(commands, target, samples::kColorDrawn, samples::kCopySource);
}

}  // namespace

io::LinearImage drawScene(Session* session, const io::Scene& scene, const io::AlbedoMap* albedo,
                          const ReadyTables& ready, const Plan& plan, const PictureTarget& target,
                          Scenery* scenery) {
  const samples::Gpu gpu = session->gpu();
  const samples::Owned<VkSampler> sampler = gpu.sampler(VK_SAMPLER_ADDRESS_MODE_REPEAT);
  headless::Image albedoImage;
  ViewDesc desc;
  desc.colorFormat = kPictureFormat;
  desc.projection = samples::projectionOf(scene.camera);
  describeView(plan, &desc);
  // Where a slice can't be recorded, recordSky reads the tables.
  desc.skySlice = ready.tables.get();
  if (albedo != nullptr) {
    albedoImage = gpu.texture(*albedo);
    desc.groundAlbedo = {albedoImage.view(), sampler.get(), samples::kSampled.layout,
                         albedoImage.extent().width, albedoImage.extent().height};
  }
  if (scenery != nullptr) scenery->describe(&desc);
  View* made = nullptr;
  session->check(createView(session->context(), desc, &made));
  const ViewPointer view(made, ViewDeleter{session});
  const SkyDraw draw = describeDraw(scene);
  if (scenery != nullptr) {
    scenery->draw(view.get(), ready.tables.get(), draw, target.image);
  } else {
    session->run([&](VkCommandBuffer commands) {
      recordPicture(session, commands, target.image, view.get(), ready.tables.get(), draw);
      return "sky";
    });
  }
  return readPicture(session, target);
}

}  // namespace alpenglow::cli
