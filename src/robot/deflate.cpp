#include "amble/robot/deflate.hpp"

#include <zlib.h>

#include "amble/core/check.hpp"

namespace amble::robot {

std::string deflated(const std::string& bytes, int level) {
  std::string stream(compressBound(static_cast<uLong>(bytes.size())), '\0');
  auto size = static_cast<uLongf>(stream.size());
  const int status =
      compress2(reinterpret_cast<Bytef*>(stream.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                static_cast<uLong>(bytes.size()), level);
  AMBLE_CHECK(status == Z_OK, "deflating into a large enough buffer");
  stream.resize(size);
  return stream;
}

std::optional<std::string> inflated(const std::optional<std::string>& stream, std::size_t bytes) {
  if (!stream) return std::nullopt;
  std::string all(bytes, '\0');
  auto size = static_cast<uLongf>(bytes);
  const int status =
      uncompress(reinterpret_cast<Bytef*>(all.data()), &size, reinterpret_cast<const Bytef*>(stream->data()),
                 static_cast<uLong>(stream->size()));
  if (status != Z_OK || size != bytes) return std::nullopt;
  return all;
}

}  // namespace amble::robot
