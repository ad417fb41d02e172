#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace dmp::io::detail {

/// CRC-32 (IEEE 802.3, clause 3.2.9): polynomial x^32 + x^26 + ... + 1 = 0x04C11DB7, bits reflected; crc32("123456789") = 0xCBF43926.
/// Detects every error in up to 32 consecutive bits. Four bytes per step: table[k][b] is the CRC of byte b followed by k zero bytes.
[[nodiscard]] inline std::uint32_t crc32(const void* data, std::size_t size) noexcept {
  using Tables = std::array<std::array<std::uint32_t, 256>, 4>;
  static constexpr Tables table = [] {
    Tables result{};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
      std::uint32_t remainder = byte;
      for (int bit = 0; bit < 8; ++bit) remainder = (remainder >> 1) ^ ((remainder & 1u) != 0 ? 0xEDB88320u : 0u);
      result[0][byte] = remainder;
    }
    for (std::size_t k = 1; k < result.size(); ++k)
      for (std::size_t byte = 0; byte < 256; ++byte) {
        const std::uint32_t shorter = result[k - 1][byte];
        result[k][byte] = (shorter >> 8) ^ result[0][shorter & 0xFFu];
      }
    return result;
  }();

  const auto* byte = static_cast<const unsigned char*>(data);
  std::uint32_t crc = 0xFFFFFFFFu;
  for (; size >= 4; size -= 4, byte += 4)
    crc = table[3][(crc ^ byte[0]) & 0xFFu] ^ table[2][((crc >> 8) ^ byte[1]) & 0xFFu] ^ table[1][((crc >> 16) ^ byte[2]) & 0xFFu] ^
          table[0][(crc >> 24) ^ byte[3]];
  for (; size > 0; --size, ++byte) crc = (crc >> 8) ^ table[0][(crc ^ *byte) & 0xFFu];
  return ~crc;
}

}  // namespace dmp::io::detail
