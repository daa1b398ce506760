// A graphics device that does everything but draw: what is left of a page's cost is what processors do beside
// a graphics card. A driver for Vulkan's loader (an ICD), which passes all on to SwiftShader
// (AMBLE_SWIFTSHADER, its library), but for draws and dispatches. Its own threads, which do what a card would
// do with the rest (clear, copy, resolve), are called skip_drawing.
#include <dlfcn.h>
#include <sys/prctl.h>
#include <vulkan/vulkan.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <string_view>

namespace {

constexpr const char* kThreads = "skip_drawing";
constexpr const char* kDevice = "a device that does not draw";  // pages look for the word SwiftShader

template <class Function>
Function of_swiftshader(const char* name) {
  static void* const library = dlopen(std::getenv("AMBLE_SWIFTSHADER"), RTLD_NOW | RTLD_LOCAL);
  return library == nullptr ? nullptr : reinterpret_cast<Function>(dlsym(library, name));
}

// What SwiftShader has at each name that is replaced here.
PFN_vkGetInstanceProcAddr instance_function = nullptr;
PFN_vkGetDeviceProcAddr device_function = nullptr;
PFN_vkGetPhysicalDeviceProperties properties = nullptr;
PFN_vkGetPhysicalDeviceProperties2 properties2 = nullptr;
PFN_vkCreateDevice create_device = nullptr;

void skip() {}  // with any arguments: the caller clears the stack

void rename(char* name) {
  std::strcpy(name, kDevice);
}

void VKAPI_CALL get_properties(VkPhysicalDevice device, VkPhysicalDeviceProperties* to) {
  properties(device, to);
  rename(to->deviceName);
  to->deviceType = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
}

void VKAPI_CALL get_properties2(VkPhysicalDevice device, VkPhysicalDeviceProperties2* to) {
  properties2(device, to);
  rename(to->properties.deviceName);
  to->properties.deviceType = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
  for (auto* more = static_cast<VkBaseOutStructure*>(to->pNext); more != nullptr; more = more->pNext)
    if (more->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES)
      rename(reinterpret_cast<VkPhysicalDeviceDriverProperties*>(more)->driverName);
}

/// Threads take their name from the thread that makes them.
VkResult VKAPI_CALL make_device(VkPhysicalDevice physical, const VkDeviceCreateInfo* with,
                                const VkAllocationCallbacks* memory, VkDevice* made) {
  std::array<char, 16> own{};
  prctl(PR_GET_NAME, own.data());
  prctl(PR_SET_NAME, kThreads);
  const VkResult result = create_device(physical, with, memory, made);
  prctl(PR_SET_NAME, own.data());
  return result;
}

PFN_vkVoidFunction VKAPI_CALL get_instance_function(VkInstance instance, const char* name);
PFN_vkVoidFunction VKAPI_CALL get_device_function(VkDevice device, const char* name);

/// Keeps SwiftShader's function, and gives the one that stands for it.
template <class Function>
PFN_vkVoidFunction replaced(PFN_vkVoidFunction theirs, Function& kept, Function ours) {
  kept = reinterpret_cast<Function>(theirs);
  return reinterpret_cast<PFN_vkVoidFunction>(ours);
}

PFN_vkVoidFunction chosen(std::string_view name, PFN_vkVoidFunction theirs) {
  if (theirs == nullptr) return nullptr;
  if (name.starts_with("vkCmdDraw") || name.starts_with("vkCmdDispatch")) return skip;
  if (name == "vkGetInstanceProcAddr") return reinterpret_cast<PFN_vkVoidFunction>(get_instance_function);
  if (name == "vkGetDeviceProcAddr") return replaced(theirs, device_function, get_device_function);
  if (name == "vkGetPhysicalDeviceProperties") return replaced(theirs, properties, get_properties);
  if (name.starts_with("vkGetPhysicalDeviceProperties2"))
    return replaced(theirs, properties2, get_properties2);
  if (name == "vkCreateDevice") return replaced(theirs, create_device, make_device);
  return theirs;
}

PFN_vkVoidFunction VKAPI_CALL get_instance_function(VkInstance instance, const char* name) {
  return chosen(name, instance_function(instance, name));
}

PFN_vkVoidFunction VKAPI_CALL get_device_function(VkDevice device, const char* name) {
  return chosen(name, device_function(device, name));
}

}  // namespace

// What the loader asks a driver for (Vulkan-Loader, LoaderDriverInterface.md).
extern "C" {

PFN_vkVoidFunction VKAPI_CALL vk_icdGetInstanceProcAddr(VkInstance instance, const char* name) {
  instance_function = of_swiftshader<PFN_vkGetInstanceProcAddr>("vk_icdGetInstanceProcAddr");
  return instance_function == nullptr ? nullptr : get_instance_function(instance, name);
}

PFN_vkVoidFunction VKAPI_CALL vk_icdGetPhysicalDeviceProcAddr(VkInstance instance, const char* name) {
  const auto theirs = of_swiftshader<PFN_vkGetInstanceProcAddr>("vk_icdGetPhysicalDeviceProcAddr");
  return theirs == nullptr ? nullptr : chosen(name, theirs(instance, name));
}

VkResult VKAPI_CALL vk_icdNegotiateLoaderICDInterfaceVersion(uint32_t* version) {
  const auto theirs =
      of_swiftshader<VkResult(VKAPI_PTR*)(uint32_t*)>("vk_icdNegotiateLoaderICDInterfaceVersion");
  return theirs == nullptr ? VK_ERROR_INCOMPATIBLE_DRIVER : theirs(version);
}

}  // extern "C"
