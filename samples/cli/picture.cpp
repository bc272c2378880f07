#include "picture.h"

#include "common/scene_plan.h"

namespace alpenglow::cli {
Painter::Painter(Session* session, const io::AlbedoMap* albedo, const ReadyTables& tables,
                 const Plan& plan, Scenery* scenery)
    : session_(session), gpu_(session->gpu()), scenery_(scenery), solver_(tables.desc.solver) {
  ViewDesc desc = plan.view;
  desc.colorFormat = kPictureFormat;
  // Where a frame can have no LUT, the view reads the tables.
  desc.sky = SkyMethod::Lut;
  if (albedo != nullptr) {
    sampler_ = gpu_.sampler(VK_SAMPLER_ADDRESS_MODE_REPEAT);
    albedo_ = gpu_.texture(*albedo);
    desc.groundAlbedo = {albedo_.view(), samples::kSampled.layout, albedo_.extent(),
                         sampler_.get()};
  }
  if (scenery != nullptr) {
    scenery->describe(&desc);
  } else {
    desc.aerialPerspective = AerialPerspective::Off;  // There is no scene.
    desc.lightShafts.method = LightShaftMethod::Off;
  }
  View* made = nullptr;
  session->check(createView(session->context(), tables.tables.get(), desc, &made));
  view_ = ViewPointer(made, ViewDeleter{session});
  if (scenery != nullptr) scenery->follow(made);
}

void Painter::drawPlain(const FrameDesc& draw, const headless::Image& target,
                        const RecordFn& stars) {
  const auto render = [&](VkCommandBuffer commands, VkAttachmentLoadOp load,
                          const std::function<void()>& record) {
    const bool first = load == VK_ATTACHMENT_LOAD_OP_CLEAR;
    gpu_.barrier(commands, target, first ? samples::kUndefined : samples::kColorDrawn,
                 samples::kColorDrawn);
    gpu_.render(commands, target, draw.cameras[0].viewport, load, nullptr, record);
  };
  session_->run([&](VkCommandBuffer commands) {
    session_->check(beginFrame(view_.get(), draw, nullptr));
    session_->check(recordLuts(view_.get(), commands));
    render(commands, VK_ATTACHMENT_LOAD_OP_CLEAR,
           [&] { session_->check(recordSky(view_.get(), commands)); });
    return "sky";
  });
  if (!stars) return;
  session_->run([&](VkCommandBuffer commands) {
    render(commands, VK_ATTACHMENT_LOAD_OP_LOAD, [&] { stars(commands); });
    return "stars";
  });
}

io::LinearImage Painter::draw(const io::Scene& scene, const Tables* tables,
                              const PictureTarget& target) {
  FrameDesc draw = samples::describeDraw(scene);
  draw.tables = tables;
  RecordFn stars;
  if (scene.stars) {
    if (!stars_) {
      const VkFormat depth = scenery_ != nullptr ? scenery_->depthFormat() : VK_FORMAT_UNDEFINED;
      stars_.emplace(&gpu_, samples::StarsDesc{tables, kPictureFormat, depth,
                                               samples::projectionOf(scene.camera), solver_});
    }
    stars = [&](VkCommandBuffer commands) {
      stars_->record(commands, scene.atmosphere, tables, draw, scene.stars->siderealHours);
    };
  }
  if (scenery_ != nullptr) {
    scenery_->draw(view_.get(), tables, draw, target.image, stars);
  } else {
    drawPlain(draw, target.image, stars);
  }
  session_->run([&](VkCommandBuffer commands) {
    gpu_.barrier(commands, target.image, samples::kColorDrawn, samples::kCopySource);
    return "readback";
  });
  session_->nextFrame();
  return readPicture(session_, target);
}

}  // namespace alpenglow::cli
