// Keys, mouse, parameters and choices, by script; and real keys on the display.
#include <alpenglow/io/flythrough_file.h>

#include <cmath>
#include <cstdlib>

#include "viewer.h"

namespace alpenglow::test {
namespace {

using nlohmann::json;

using ViewerControls = Viewer;

TEST_F(ViewerControls, EachKeyMovesItsNumberThereAndBack) {
  const struct {
    const char *key, *back, *parameter;
    double step;
  } kKeys[] = {{"Up", "Down", "sun.elevation_deg", 0.5},
               {"Right", "Left", "sun.azimuth_deg", 0.5},
               {"O", "I", "rayleigh.scattering_per_m.0", 0.05 * 5.8e-6},
               {"L", "K", "mie.extinction_per_m.1", 0.05 * 2.22e-5},
               {"J", "H", "mie.asymmetry", 0.01},
               {"G", "F", "turbidity", 0.1}};
  std::string script = "report @start.json\n";
  for (const auto& key : kKeys) {
    script += std::string("press ") + key.key + "\nreport @" + key.key + ".json\npress " +
              key.back + "\nreport @" + key.back + ".json\n";
  }
  play(script);
  const json start = report("start.json")["parameters"];
  for (const auto& key : kKeys) {
    const double before = start[key.parameter];
    const double there = report(std::string(key.key) + ".json")["parameters"][key.parameter];
    const double back = report(std::string(key.back) + ".json")["parameters"][key.parameter];
    EXPECT_NEAR(there - before, key.step, 1e-6 * key.step) << key.key;
    EXPECT_NEAR(back, before, 1e-9 * std::abs(before)) << key.back;
  }
}

TEST_F(ViewerControls, FlightsFollowTheAltitude) {
  play(
      "report @a.json\nfly 0 0 1 60\nreport @b.json\nset camera.altitude_m 36000000\n"
      "fly 0 0 1 60\nreport @c.json\npress R\nreport @d.json\nfly 1 0 0 60\nreport @e.json\n"
      "drag 80 -20\nreport @f.json");
  const auto of = [&](const char* name, const char* parameter) {
    return report(name)["parameters"][parameter].get<double>();
  };
  const double low = of("b.json", "camera.altitude_m") - of("a.json", "camera.altitude_m");
  const double high = of("c.json", "camera.altitude_m") - 36e6;
  EXPECT_GT(low, 300.0);
  EXPECT_LT(low, 1000.0);
  EXPECT_GT(high, 20e6);  // As far in a second as it is high, about.
  EXPECT_EQ(of("d.json", "camera.altitude_m"), 500.0);
  // East along the parallel; the sun stays where it is, so that it stands higher over there.
  EXPECT_GT(of("e.json", "camera.longitude_deg"), of("d.json", "camera.longitude_deg"));
  EXPECT_GT(of("e.json", "sun.elevation_deg"), of("d.json", "sun.elevation_deg"));
  EXPECT_LT(of("f.json", "camera.heading_deg"), of("e.json", "camera.heading_deg"));
  EXPECT_LT(of("f.json", "camera.pitch_deg"), of("e.json", "camera.pitch_deg"));
}

TEST_F(ViewerControls, EveryParameterCanBeSet) {
  play("report @before.json\n");
  const json before = report("before.json")["parameters"];
  std::string script;
  size_t count = 0;
  for (const auto& [name, value] : before.items()) {
    if (name == "turbidity") continue;
    const double now = value.get<double>();
    const double wanted = name == "top_radius_m"      ? 6.43e6
                          : name == "bottom_radius_m" ? 6.355e6
                          : now == 0.0                ? 0.5
                                                      : 0.93 * now;
    script += "set " + name + " " + json(wanted).dump() + "\nframes 2\n";
    ++count;
  }
  EXPECT_GE(count, 35u);
  play(script + "settle\nreport @after.json\n");
  const json after = report("after.json");
  EXPECT_EQ(after["message"], "");
  EXPECT_EQ(after["refusal"], "");
  for (const auto& [name, value] : after["parameters"].items()) {
    if (name == "turbidity") continue;  // A ratio of what has all become 0.93 of itself.
    EXPECT_NE(value, before[name]) << name;
  }
}

TEST_F(ViewerControls, EveryChoiceDraws) {
  std::string script = "choose stars on\n";
  for (const char* choice : {"preset mars",
                             "preset earth",
                             "model single",
                             "model hoffman-preetham",
                             "model oneil",
                             "model schafhitzel",
                             "model hillaire",
                             "model bruneton",
                             "quality low",
                             "quality draft",
                             "orders 2",
                             "orders all",
                             "tone_map linear",
                             "tone_map reinhard",
                             "tone_map filmic",
                             "effects.mie off",
                             "effects.mie as planned",
                             "effects.multiple_scattering off",
                             "effects.multiple_scattering on",
                             "effects.ground off",
                             "effects.ground as planned",
                             "effects.sun_disc off",
                             "effects.rayleigh off"}) {
    script += std::string("choose ") + choice + "\nsettle\n";
  }
  play(script + "report @report.json\n");
  const json end = report();
  EXPECT_EQ(end["message"], "");
  EXPECT_EQ(end["refusal"], "");
  EXPECT_TRUE(end["parameters"].contains("stars.sidereal_hours"));
}

TEST_F(ViewerControls, RefusalsAreReportedAndKeepTheScene) {
  // Nothing of the ground in the pipelines, and a camera that looks at it.
  play(
      "settle\nchoose effects.ground off\nset camera.pitch_deg -30\nframes 40\nreport "
      "@report.json\n");
  EXPECT_NE(report()["refusal"].get<std::string>().find("ground"), std::string::npos) << report();
}

TEST_F(ViewerControls, OtherTablesWhileADraftIsBakedAreWaitedFor) {
  play(
      "settle\nset mie.asymmetry 0.7\nframes 1\nchoose solver standard\nframes 1\n"
      "choose effects.mie off\nframes 2\nchoose solver moments\nchoose quality low\nframes 1\n"
      "set mie.asymmetry 0.6\nchoose model hillaire\nframes 1\nchoose model bruneton\n"
      "choose effects.mie on\nsettle\nreport @report.json\n");
  EXPECT_EQ(report()["message"], "");
  EXPECT_EQ(report()["refusal"], "");
  EXPECT_EQ(report()["scene"]["quality"], "low");
}

TEST_F(ViewerControls, APlanetTooSmallForTheTerrainIsTakenBack) {
  scene_ = ALPENGLOW_SAMPLES "/scenes/mountain_shadows.json";
  play(
      "choose quality draft\nsettle\nreport @before.json\nset bottom_radius_m 20000\n"
      "set top_radius_m 80000\nsettle\nreport @after.json\nfly 1 0 0 5\nsettle\n"
      "report @moved.json\n");
  EXPECT_NE(report("after.json")["message"], "");
  EXPECT_EQ(report("after.json")["parameters"]["bottom_radius_m"],
            report("before.json")["parameters"]["bottom_radius_m"]);
  EXPECT_EQ(report("moved.json")["refusal"], "");
}

TEST_F(ViewerControls, SeekingPausesTheFlythrough) {
  play("seek 4.5\nframes 2\nreport @report.json\n",
       {"--flythrough", ALPENGLOW_SAMPLES "/flythroughs/summit_to_orbit.json"});
  const io::Result<io::Flythrough> flythrough =
      io::readFlythrough(ALPENGLOW_SAMPLES "/flythroughs/summit_to_orbit.json");
  ASSERT_TRUE(flythrough) << flythrough.error;
  const io::Scene scene = io::sceneAt(*flythrough, 4.5);
  EXPECT_EQ(report()["caption"], io::keyAt(*flythrough, 4.5).caption);
  EXPECT_NEAR(report()["parameters"]["camera.altitude_m"].get<double>(), scene.camera.altitude_m,
              1e-6 * scene.camera.altitude_m);
}

// Everything above goes past the window system; this doesn't.
TEST_F(ViewerControls, RealKeysAndARealMouseReachIt) {
  const std::string steps = folder_.write("keys.sh", R"sh(#!/bin/bash
cd "$1"
for i in $(seq 100); do
  window=$(xdotool search --onlyvisible --name '^Alpenglow$' 2>/dev/null | head -1)
  [[ -n "$window" ]] && xdotool windowfocus "$window"
  [[ -n "$window" && "$(xdotool getwindowfocus)" == "$window" ]] && break
  sleep 0.2
done
sleep 2
xdotool key F1
sleep 0.5
xdotool key Tab
xdotool mousemove 500 300 mousedown 1
sleep 0.3
xdotool mousemove_relative 60 0
sleep 0.3
xdotool mouseup 1
xdotool keydown w
sleep 0.5
xdotool keyup w
xdotool key period
for i in $(seq 200); do
  ls alpenglow_*.png > /dev/null 2>&1 && break
  sleep 0.2
done
for i in $(seq 20); do
  xdotool search --name '^Alpenglow$' > /dev/null 2>&1 || break
  xdotool key Escape
  sleep 0.5
done
xdotool search --name '^Alpenglow$' && kill "$(xdotool getwindowpid "$window")"
)sh");
  const std::string command = "DISPLAY=" + display_.name() + " bash '" + steps + "' '" +
                              folder_.path() + "' > '" + at("keys.log") + "' 2>&1 &";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string before = std::filesystem::current_path();
  std::filesystem::current_path(folder_.path());
  const Outcome outcome = run({scene_, "--size", "800x500"});
  std::filesystem::current_path(before);
  EXPECT_EQ(outcome.status, 0) << outcome.err << contentsOf(at("keys.log"));
  size_t pictures = 0;
  for (const std::string& name : folder_.names()) {
    if (name.starts_with("alpenglow_") && name.ends_with(".png")) ++pictures;
  }
  EXPECT_EQ(pictures, 1u) << contentsOf(at("keys.log"));
}

}  // namespace
}  // namespace alpenglow::test
