#pragma once

#include <tl/expected.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

enum class EArmRelayWidth : std::uint8_t
{
    Bit,
    Byte, ///< "b"
    Word, ///< "w": 2 bytes.
    Long, ///< "l": 4 bytes.
};

/// The unit of the number in a relay's name.
enum class EArmRelayIndex : std::uint8_t
{
    Value, ///< Values of the relay's width: ml105 begins at byte 420.
    Byte,  ///< Bytes, unless it is a bit: ml420 begins at byte 420.
};

/// A relay of an arm's controller that can be written by its name and read back through val_s32.
struct ArmRelay
{
    std::string name; ///< "ml105", "fb0.do3"
    std::string url;  ///< Of the val_s32 that shows it: "/project/plc/m/val_s32", "/project/plc/fb0_do/val_s32".
    EArmRelayWidth width = EArmRelayWidth::Bit;
    std::uint32_t firstByte = 0;
    std::uint8_t bit = 0; ///< In that byte; 0 unless it is a bit.

    bool operator==(const ArmRelay&) const = default;
};

/// Names are [fb0.|fn0.]{di,do,x,y,m,s,r,k}[b|w|l]NUMBER in lower case. The error is a sentence about the name.
[[nodiscard]] tl::expected<ArmRelay, std::string> ParseArmRelay(std::string_view name, EArmRelayIndex index);

/// The number counts values.
[[nodiscard]] tl::expected<ArmRelay, std::string> ParseArmRelay(std::string_view name);

/// Whether the relay is wide enough. The value may be signed or unsigned.
[[nodiscard]] bool CanHold(const ArmRelay& relay, std::int64_t value) noexcept;

/// The range of its values, for a message: "-128 to 255".
[[nodiscard]] std::string MakeRangeText(const ArmRelay& relay);

/// Whether the two share a bit.
[[nodiscard]] bool IsOverlapping(const ArmRelay& left, const ArmRelay& right) noexcept;

/// The first byte and the number of 32-bit words by which val_s32 shows some relays of one URL.
struct ArmRelayRange
{
    std::string url;
    std::uint32_t firstByte = 0; ///< A multiple of 4.
    std::uint32_t words = 0;

    bool operator==(const ArmRelayRange&) const = default;
};

/// The ranges that cover all relays. A long gap between two relays of one URL separates two ranges.
[[nodiscard]] std::vector<ArmRelayRange> MakeRelayRanges(const std::vector<ArmRelay>& relays);

/// The relay's value in the words of the range, signed unless it is a bit; nullopt if the range does not contain the relay.
[[nodiscard]] std::optional<std::int32_t> ReadRelayOrNull(
    const ArmRelay& relay,
    const ArmRelayRange& range,
    const std::vector<std::int64_t>& words);

/// Whether the value that was read equals the written one, which may be unsigned.
[[nodiscard]] bool IsSameValue(const ArmRelay& relay, std::int32_t written, std::int32_t read) noexcept;

} // namespace ACS::Acsd
