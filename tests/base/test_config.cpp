#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/config.hpp"

namespace titin {
namespace {

enum class Kind { dynamic, quasi_static };

/// A small scene with a key of every type.
struct Scene {
  std::string title;
  Kind kind = Kind::dynamic;
  double end = 0, step = 0.01, fat = 0;
  int cuts = 8;
  bool fields = true;
  std::array<double, 3> size{0.03, 0.01, 0.01};
  std::vector<int> cells{1, 1, 1};
  std::vector<double> weights;
  std::vector<std::string> markers;
  std::map<std::string, Table> boundary;
  Table activation;

  void bind(Section s) {
    s.read("title", title, {.doc = "headline"});
    s.choose("kind", kind, {{"dynamic", Kind::dynamic}, {"quasi-static", Kind::quasi_static}},
             {.doc = "inertia or not"});
    Section time = s.section("time", "when");
    time.read("end", end, {.unit = "s", .range = positive, .required = true, .doc = "end of the simulated time"});
    time.read("step", step, {.unit = "s", .range = positive, .doc = "time step"});
    time.read("cuts", cuts, {.range = {.min = 0, .max = 20}});
    Section mesh = s.section("mesh");
    mesh.read("size", size, {.unit = "m", .range = positive});
    mesh.read("cells", cells, {.range = {.min = 1}});
    Section more = s.section("more");
    more.read("fat", fat, {.range = fraction});
    more.read("fields", fields, {});
    more.read("weights", weights, {});
    more.read("markers", markers, {});
    s.read("activation", activation, {.range = fraction});
    s.each("boundary", "named parts of the surface",
           [&](const std::string& name, Section b) { b.read("displacement", boundary[name], {.unit = "m"}); });
  }
};

Scene read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  Config config(text, "block.toml", overrides);
  Scene scene;
  scene.bind(config.root());
  config.finish();
  return scene;
}

std::vector<std::string> errors(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    read(text, overrides);
  } catch (const InputError& error) {
    return error.messages();
  }
  return {};
}

using Messages = std::vector<std::string>;
const std::string time_table = "[time]\nend = \"0.5 s\"\n";  // lines 1 and 2

TEST(Config, ReadsEveryTypeOfKey) {
  const Scene s = read(R"(
title = "a block"
kind = "quasi-static"
activation = {time = "0, 100 ms", value = [0, 1]}
[time]
end = "500 ms"
step = "25 ms"
cuts = 3
[mesh]
size = "30, 10, 10 mm"
cells = [8, 4, 4]
[more]
fat = "10 %"
fields = false
weights = [1, 2.5]
markers = ["a", "b"]
[boundary."x+"]
displacement = {time = [ "0 s", "0.1 s" ], value = "0, 3 mm"}
[boundary.left]
displacement = "1 cm"
)");
  EXPECT_EQ(s.title, "a block");
  EXPECT_EQ(s.kind, Kind::quasi_static);
  EXPECT_EQ(s.end, 0.5);
  EXPECT_EQ(s.step, 0.025);
  EXPECT_EQ(s.cuts, 3);
  EXPECT_EQ(s.size, (std::array<double, 3>{0.03, 0.01, 0.01}));
  EXPECT_EQ(s.cells, (std::vector{8, 4, 4}));
  EXPECT_EQ(s.fat, 0.1);
  EXPECT_FALSE(s.fields);
  EXPECT_EQ(s.weights, (std::vector<double>{1.0, 2.5}));
  EXPECT_EQ(s.markers, (Messages{"a", "b"}));
  EXPECT_EQ(s.activation.time(), (std::vector<double>{0.0, 0.1}));
  EXPECT_DOUBLE_EQ(s.boundary.at("x+")(0.05), 0.0015);
  EXPECT_EQ(s.boundary.at("left")(0), 0.01);
}

TEST(Config, KeepsDefaultsOfAbsentKeys) {
  const Scene s = read(time_table);
  EXPECT_EQ(s.step, 0.01);
  EXPECT_EQ(s.kind, Kind::dynamic);
  EXPECT_TRUE(s.boundary.empty());
}

TEST(Config, SaysDidYouMean) {
  EXPECT_EQ(errors("[time]\nendd = \"0.5 s\"\n"),
            Messages{"block.toml:2:1: time.endd: unknown key; did you mean \"end\"?"});
  EXPECT_EQ(errors("[tiem]\nend = \"0.5 s\"\n"), Messages{"block.toml:1:2: tiem: unknown key; did you mean \"time\"?"});
  EXPECT_EQ(errors("step = \"1 s\"\n" + time_table),
            Messages{"block.toml:1:1: step: unknown key; did you mean time.step?"});
  EXPECT_EQ(errors(time_table + "viscosity = 3\n"),
            Messages{"block.toml:3:1: time.viscosity: unknown key; known here: end, step, cuts"});
  EXPECT_EQ(errors(time_table + "[boundary.\"x+\"]\ndisplacment = \"1 mm\"\n"),
            Messages{"block.toml:4:1: boundary.\"x+\".displacment: unknown key; did you mean \"displacement\"?"});
  EXPECT_EQ(errors("kind = \"dinamic\"\n" + time_table),
            Messages{"block.toml:1:8: kind: \"dinamic\" is not known here; did you mean \"dynamic\"? allowed: dynamic, "
                     "quasi-static"});
}

TEST(Config, MissesRequiredKeysOnce) {
  EXPECT_EQ(errors("[time]\n"),
            Messages{"block.toml:1:1: time.end: missing (end of the simulated time); add for example "
                     "end = \"25 ms\" to [time]"});
  EXPECT_EQ(errors(""), Messages{"block.toml: time.end: missing (end of the simulated time); add for example "
                                 "end = \"25 ms\" to [time]"});
  EXPECT_EQ(errors("time = 3\n"), Messages{"block.toml:1:8: time: 3 is no table; write [time] and its keys below"});
}

TEST(Config, ReportsAllErrorsInTheOrderOfTheFile) {
  EXPECT_EQ(
      errors("[time]\nend = 0.5\nstep = \"25 mm\"\ncuts = 99\n[mesh]\nsize = \"1, 2 mm\"\ncells = [1, 2.5, 0]\n"
             "[more]\nfat = nan\nfields = 1\n"),
      (Messages{
          "block.toml:2:7: time.end: 0.5 has no unit; write a time with its unit, such as \"25 ms\"",
          "block.toml:3:8: time.step: \"25 mm\" is not a time: \"mm\" cannot be converted to s; write a time, such "
          "as \"25 ms\"",
          "block.toml:4:8: time.cuts: 99 is out of range; allowed: 0 to 20",
          "block.toml:6:8: mesh.size: has 2 numbers; give 3",
          "block.toml:7:9: mesh.cells: entry 3 (0) is out of range; allowed: >= 1",
          "block.toml:9:7: more.fat: nan is not a finite number; write a pure number, such as 0.3",
          "block.toml:10:10: more.fields: 1 is neither true nor false; write true or false",
      }));
}

TEST(Config, ChecksRangesInSi) {
  EXPECT_EQ(errors("[time]\nend = \"-5 ms\"\n"),
            Messages{"block.toml:2:7: time.end: \"-5 ms\" is out of range; allowed: > 0 s"});
  EXPECT_EQ(errors(time_table + "[mesh]\nsize = \"1, -2, 3 mm\"\n"),
            Messages{"block.toml:4:8: mesh.size: entry 2 (-0.002 m) is out of range; allowed: > 0 m"});
  EXPECT_EQ(errors(time_table + "[mesh]\ncells = [1, 2.5, 3]\n"),
            Messages{"block.toml:4:9: mesh.cells: 2.5 is not a whole number; write one, such as 3"});
  EXPECT_EQ(errors(time_table + "[more]\nmarkers = [1]\n"),
            Messages{"block.toml:4:11: more.markers: is no list of text; write for example [\"a\", \"b\"]"});
}

TEST(Config, ChecksCurves) {
  const auto curve = [](const std::string& text) { return errors("activation = " + text + "\n" + time_table); };
  EXPECT_EQ(
      curve(R"({time = "0, 0.3, 0.1 s", value = [0, 1, 0]})"),
      Messages{"block.toml:1:22: activation.time: does not increase: entry 3 (0.1 s) follows 0.3 s; sort the times, "
               "each once"});
  EXPECT_EQ(curve(R"({time = "0, 0.3 s", value = [0, 1, 0]})"),
            Messages{"block.toml:1:14: activation: has 2 times and 3 values; give a value for each time"});
  EXPECT_EQ(curve(R"({time = "0, 0.3 s", value = [0, 2]})"),
            Messages{"block.toml:1:14: activation: entry 2 (2) is out of range; allowed: 0 to 1"});
  EXPECT_EQ(curve("{}"), Messages{"block.toml:1:14: activation: has no points; give either time and value, or file"});
  EXPECT_EQ(
      curve(R"({time = "0, 0.3 s"})"),
      Messages{"block.toml:1:14: activation.value: missing (values at these times); add for example value = 0.3 to "
               "[activation]"});
  EXPECT_EQ(curve(R"({times = "0, 0.3 s", value = [0, 1]})"),
            Messages{"block.toml:1:15: activation.times: unknown key; did you mean \"time\"?"});
  EXPECT_EQ(curve(R"({file = "not/there.dat"})"),
            Messages{"block.toml:1:22: activation.file: file \"not/there.dat\" is not there; give its path from the "
                     "scene's own folder (looked for \"not/there.dat\")"});
}

TEST(Config, DoesNotBlameATableForAKeyThatIsWrong) {
  Config config("[mesh]\nbox = 3\n", "block.toml");
  Section mesh = config.root().section("mesh");
  double box = 0;
  mesh.read("box", box, {.unit = "m"});
  mesh.error("", "no mesh");
  try {
    config.finish();
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.messages().size(), 1u);
  }
}

TEST(Config, TakesOverridesInTheGrammarOfTheFile) {
  const Scene s = read(time_table + "[boundary.\"x+\"]\ndisplacement = {time = \"0, 1 s\", value = \"0, 3 mm\"}\n",
                       {"time.step=25 ms", "time.step = \"50 ms\"", "mesh.cells=[2, 3, 4]", "mesh.size=30, 10, 10 mm",
                        "kind=quasi-static", "boundary.x+.displacement.value=0, 6 mm",
                        "boundary.\"y-\".displacement=1 mm", "more.fat=10 %", "more.fields=false", "title=a=b"});
  EXPECT_EQ(s.step, 0.05);
  EXPECT_EQ(s.cells, (std::vector{2, 3, 4}));
  EXPECT_EQ(s.size, (std::array<double, 3>{0.03, 0.01, 0.01}));
  EXPECT_EQ(s.kind, Kind::quasi_static);
  EXPECT_EQ(s.boundary.at("x+").value(), (std::vector<double>{0.0, 0.006}));
  EXPECT_EQ(s.boundary.at("y-")(0), 0.001);
  EXPECT_EQ(s.fat, 0.1);
  EXPECT_FALSE(s.fields);
  EXPECT_EQ(s.title, "a=b");
  EXPECT_EQ(read(time_table, {"mesh.cells=2,3,4"}).cells, (std::vector{2, 3, 4}));
}

TEST(Config, TakesKeysOut) {
  EXPECT_EQ(
      errors(time_table, {"~time.end"}),
      Messages{"block.toml:1:1: time.end: missing (end of the simulated time); add for example end = \"25 ms\" to "
               "[time]"});
  EXPECT_EQ(errors(time_table, {"~time.stp", "~a.b"}),
            (Messages{"command line: \"~time.stp\": the scene does not say this; drop the removal, or name a key or a "
                      "table that it has",
                      "command line: \"~a.b\": the scene does not say this; drop the removal, or name a key or a table "
                      "that it has"}));
}

TEST(Config, BlamesTheCommandLine) {
  EXPECT_EQ(errors(time_table, {"time.stp=1 s"}),
            Messages{"command line: time.stp: unknown key; did you mean \"step\"?"});
  EXPECT_EQ(errors(time_table, {"time.step=25"}),
            Messages{"command line: time.step: 25 has no unit; write a time with its unit, such as \"25 ms\""});
  EXPECT_EQ(errors(time_table, {"time.step", "=3", "a..b=1", "time.end="}),
            (Messages{"command line: \"time.step\": is no key=value; write for example time.step=\"25 ms\"",
                      "command line: \"=3\": is no key=value; write for example time.step=\"25 ms\"",
                      "command line: \"a..b=1\": is no key=value; write for example time.step=\"25 ms\"",
                      "command line: \"time.end=\": has no value; write key=value"}));
  EXPECT_EQ(errors("", {"time.step=1 s"}),
            Messages{"command line: time.end: missing (end of the simulated time); add for example end = \"25 ms\" to "
                     "[time]"});
  EXPECT_EQ(errors(time_table, {"time.end.x=3"}),
            Messages{"command line: \"time.end.x=3\": time.end is not a table; override it as a whole"});
  const auto broken = errors(time_table, {"activation={time"});
  ASSERT_EQ(broken.size(), 1u);
  EXPECT_EQ(broken[0].rfind("command line: \"activation={time\": its right side is not valid TOML (", 0), 0u)
      << broken[0];
}

TEST(Config, DoesNotJudgeWhatAnUnknownWordLeftUnread) {
  Config config("law = \"yeho\"\nc1 = 3\n", "block.toml");
  Section s = config.root();
  int law = 0;
  s.choose_word("law", law, {"yeoh", "neo_hookean"}, {});
  try {
    config.finish();
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.messages(),
              Messages{"block.toml:1:7: law: \"yeho\" is not known here; did you mean \"yeoh\"? allowed: "
                       "yeoh, neo_hookean"});
  }
}

TEST(Config, WritesWhatItUnderstood) {
  const std::string text = R"(title = "a \"block\""
activation = {time = "0, 0.3 s", value = [0.1, 0.7]}
[time]
end = "500 ms"
[boundary."x+"]
displacement = {time = "0, 100 ms", value = "0, 1", scale = "3 mm"}
[boundary.free]
)";
  const auto resolved = [](const std::string& scene) {
    Config config(scene, "block.toml");
    Scene s;
    s.bind(config.root());
    config.finish();
    return config.resolved();
  };
  const std::string first = resolved(text);
  EXPECT_EQ(first, R"(title = "a \"block\""
kind = "dynamic"
activation = {time = "0, 0.3 s", value = [0.1, 0.7]}

[time]
end = "0.5 s"
step = "0.01 s"
cuts = 8

[mesh]
size = "0.03, 0.01, 0.01 m"
cells = [1, 1, 1]

[more]
fat = 0
fields = true

[boundary]

[boundary."x+"]
displacement = {time = "0, 0.1 s", value = "0, 0.003 m"}

[boundary.free]
displacement = "0 m"
)");
  EXPECT_EQ(resolved(first), first);
}

// A formulation that asks whether a key is there takes another way when it is: a default must not appear.
TEST(Config, DoesNotWriteDefaultsWhosePresenceMatters) {
  Config config("a = 1\n", "block.toml");
  Section s = config.root();
  double a = 0, b = 2, c = 3;
  s.read("a", a, {});
  if (!s.has("b")) s.read("b", b, {});
  if (!s.has("sub")) s.section("sub").read("c", c, {});
  EXPECT_EQ(config.resolved(), "a = 1\n");
}

// "none" is a default that no scene can say.
TEST(Config, DoesNotWriteDefaultsOutsideTheirOwnRange) {
  Config config("a = 1\n", "block.toml");
  Section s = config.root();
  double a = 0, interval = 0, infinite = std::numeric_limits<double>::infinity();
  Table pressure(-1);
  std::string file;
  std::vector<int> cells;
  s.read("a", a, {});
  s.read("cells", cells, {.range = {.min = 1}});
  s.read("interval", interval, {.unit = "s", .range = positive});
  s.read("infinite", infinite, {.unit = "s"});
  s.read("pressure", pressure, {.unit = "Pa", .range = positive});
  s.read("file", file, {});
  EXPECT_EQ(config.resolved(), "a = 1\n");
}

TEST(Config, ListsItsKeys) {
  Config config = Config::describing();
  Scene().bind(config.root());
  config.finish();
  std::map<std::string, KeyRecord> keys;
  for (const KeyRecord& key : config.keys()) keys[key.path] = key;
  const KeyRecord step = keys.at("time.step");
  EXPECT_EQ(step.unit, "s");
  EXPECT_EQ(step.default_value, "0.01 s");
  EXPECT_EQ(step.range, "> 0");
  EXPECT_EQ(step.doc, "time step");
  EXPECT_TRUE(keys.at("time.end").required);
  EXPECT_EQ(keys.at("kind").choices, (Messages{"dynamic", "quasi-static"}));
  EXPECT_EQ(keys.at("boundary.<NAME>.displacement").type, "number or curve in time");
  EXPECT_EQ(keys.at("mesh.cells").default_value, "1, 1, 1");
}

TEST(Config, ListsAKeyAndATableOfOneName) {
  Config config = Config::describing();
  bool wall = false;
  config.root().section("wall", "a plane");
  config.root().read("wall", wall, {});
  config.root().read("wall", wall, {});
  Messages types;
  for (const KeyRecord& key : config.keys()) types.push_back(key.path + ": " + key.type);
  EXPECT_EQ(types, (Messages{"wall: table", "wall: true or false"}));
}

TEST(Config, WalksNamedTablesInFileOrder) {
  Config config("[b.z]\n[b.a]\n", "block.toml", {"b.c.x=1"});
  Messages names;
  config.root().each("b", "", [&](const std::string& name, Section) { names.push_back(name); });
  EXPECT_EQ(names, (Messages{"z", "a", "c"}));
}

TEST(Config, RefusesHostileText) {
  const auto first = [](const std::string& text) {
    const auto messages = errors(text);
    return messages.empty() ? "" : messages.front().substr(0, 34);
  };
  EXPECT_EQ(first("a = " + std::string(100000, '[')), "block.toml:1:261: not valid TOML: ");
  EXPECT_EQ(first("title = \"\xff\xfe\"\n"), "block.toml:1:9: not valid TOML: En");
  EXPECT_EQ(first(std::string("a\0b = 1", 7)).substr(0, 11), "block.toml:");
  std::string deep = "a";
  for (int i = 0; i < 1000000; ++i) deep += ".a";
  EXPECT_EQ(errors("\n" + deep + " = 1\n"),
            Messages{"block.toml:2: a key with more than 32 dots; name tables less deeply"});
  EXPECT_EQ(errors(time_table, {deep + "=1"}).size(), 1u);
  EXPECT_TRUE(errors(time_table + "# " + std::string(100, '.') + "\n").empty());
  std::string many;
  for (int i = 0; i < 1000; ++i) many.append("x").append(std::to_string(i)).append(" = 1\n");
  EXPECT_EQ(errors(many + time_table).size(), 51u);
}

class Files : public testing::Test {
 protected:
  std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "titin_config";
  void SetUp() override { std::filesystem::create_directories(folder); }
  void TearDown() override { std::filesystem::remove_all(folder); }
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder / name) << text;
    return (folder / name).string();
  }
};

Scene read_file(const std::string& file) {
  Config config = Config::read_file(file);
  Scene scene;
  scene.bind(config.root());
  config.finish();
  return scene;
}

TEST_F(Files, AreLookedForBesideTheScene) {
  write("strain.dat", "0 0\n1 0.5\n");
  const Scene s =
      read_file(write("a.toml", time_table + "[boundary.x]\n"
                                             "displacement = {file = \"strain.dat\", scale = \"30 mm\"}\n"));
  EXPECT_DOUBLE_EQ(s.boundary.at("x")(1), 0.015);
}

TEST_F(Files, ThatAreWrongAreNamedWithTheirLine) {
  write("strain.dat", "0 0\n1 0.5\n1 0.6\n");
  const std::string scene = write("a.toml", "activation = {file = \"strain.dat\"}\n" + time_table);
  try {
    read_file(scene);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(
        error.messages(),
        Messages{scene + ":1:22: activation.file: file \"strain.dat\": line 3: time 1 s does not come after 1 s of "
                         "line 2; write two columns: time in s, increasing, and value"});
  }
}

TEST_F(Files, ThatAreNoScenesGetASentence) {
  const auto message = [](const std::string& file) {
    try {
      Config::read_file(file);
    } catch (const InputError& error) {
      return error.messages().front();
    }
    return std::string();
  };
  EXPECT_EQ(message("nowhere.toml"), "nowhere.toml: the scene file is not there; give the path of a TOML scene");
  EXPECT_EQ(message(folder.string()),
            folder.string() + ": the scene file is a folder, not a file; give the path of a TOML scene");
  const std::string large = write("large.toml", "");
  std::filesystem::resize_file(large, 17u << 20);
  EXPECT_EQ(message(large),
            large + ": the scene file has 17 MB; more than 16 MB is no such text; give the path of a TOML scene");
}

}  // namespace
}  // namespace titin
