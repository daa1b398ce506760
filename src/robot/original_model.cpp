#include "amble/robot/original_model.hpp"

#include <cstdint>
#include <utility>

#include "amble/io/base64.hpp"
#include "amble/robot/deflate.hpp"

namespace amble::robot {
namespace {

constexpr std::int64_t largest_mesh_bytes = 50'000'000;

std::vector<int> numbers_of(const io::JsonView& json, std::size_t count) {
  if (json.size() != count) json.bad("a number for each of the robot's");
  std::vector<int> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t number = json.at(i).integer();
    if (number < 0 || number > 1'000'000) json.at(i).bad("an index");
    numbers.push_back(static_cast<int>(number));
  }
  return numbers;
}

}  // namespace

io::Json to_json(const OriginalModel& model) {
  io::Json meshes = io::Json::object();
  for (const auto& [name, bytes] : model.meshes)
    meshes[name] = {{"bytes", bytes.size()}, {"deflated", io::base64(deflated(bytes))}};
  return {{"mjcf", model.mjcf},
          {"meshes", std::move(meshes)},
          {"start_qpos", model.start},
          {"joints", model.joints},
          {"geoms", model.geoms}};
}

std::shared_ptr<const OriginalModel> original_model_from_json(const io::JsonView& json,
                                                              const RobotSpec& robot) {
  auto model = std::make_shared<OriginalModel>();
  model->mjcf = json.at("mjcf").text();
  const io::JsonView meshes = json.at("meshes");
  if (!meshes.raw().is_object()) meshes.bad("an object");
  for (const auto& [name, value] : meshes.raw().items()) {
    const io::JsonView mesh = meshes.at(name);
    const std::int64_t size = mesh.at("bytes").integer();
    if (size < 0 || size > largest_mesh_bytes) mesh.at("bytes").bad("a number of bytes");
    auto bytes = inflated(io::from_base64(mesh.at("deflated").text()), static_cast<std::size_t>(size));
    if (!bytes) mesh.at("deflated").bad("a zlib stream of so many bytes, in base64");
    model->meshes[name] = std::move(*bytes);
  }
  const io::JsonView start = json.at("start_qpos");
  for (std::size_t i = 0; i < start.size(); ++i) model->start.push_back(start.at(i).finite_number());
  model->joints = numbers_of(json.at("joints"), robot.joints.size());
  model->geoms = numbers_of(json.at("geoms"), robot.geoms.size());
  return model;
}

bool same_original_model(const RobotSpec& a, const RobotSpec& b) {
  if (a.original == b.original) return true;
  return a.original && b.original && to_json(*a.original) == to_json(*b.original);
}

}  // namespace amble::robot
