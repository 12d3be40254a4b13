#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <tuple>

namespace ACS::OpenStreamSim
{

/// Size of every block of relays.
inline constexpr std::size_t RELAY_BYTES = 4096;
inline constexpr std::size_t BITS_PER_BYTE = 8;

enum class ERelayBus : std::uint8_t
{
    None, ///< The controller's own.
    Fb,   ///< Fieldbus block, fb0 to fb9.
    Fn,   ///< Fieldbus node, fn0 to fn63.
};

enum class ERelayArea : std::uint8_t
{
    Di,
    Do,
    X,
    Y,
    M,
    S,
    R,
    K,
    Si,
    So,
};

enum class ERelayWidth : std::uint8_t
{
    Bit,
    Byte,  ///< "b": 8 bits.
    Word,  ///< "w": 16 bits.
    Long,  ///< "l": 32 bits.
    Float, ///< "f": 32 bits.
};

/// One block of relays: RELAY_BYTES bytes.
struct RelayBlock
{
    ERelayBus bus = ERelayBus::None;
    std::uint8_t index = 0;
    ERelayArea area = ERelayArea::M;

    bool operator==(const RelayBlock&) const = default;

    bool operator<(const RelayBlock& other) const
    {
        return std::tie(bus, index, area) < std::tie(other.bus, other.index, other.area);
    }
};

/// An area and the width of its values: "m", "dob", "dil".
struct RelayType
{
    ERelayArea area = ERelayArea::M;
    ERelayWidth width = ERelayWidth::Bit;

    bool operator==(const RelayType&) const = default;
};

/// One value. The number counts values of its width: m100 is bit 100 (byte 12), mb400, mw200, ml100 and mf100 all begin
/// at byte 400.
struct RelayName
{
    RelayBlock block;
    ERelayWidth width = ERelayWidth::Bit;
    std::size_t number = 0;

    bool operator==(const RelayName&) const = default;
};

[[nodiscard]] constexpr std::size_t GetBytes(ERelayWidth width) noexcept
{
    switch (width)
    {
        case ERelayWidth::Word:
            return 2;
        case ERelayWidth::Long:
        case ERelayWidth::Float:
            return 4;
        case ERelayWidth::Bit:
        case ERelayWidth::Byte:
        default:
            return 1;
    }
}

/// The first byte of the value.
[[nodiscard]] std::size_t GetFirstByte(const RelayName& name) noexcept;

/// Whether the whole value lies inside its block.
[[nodiscard]] bool IsInside(const RelayName& name) noexcept;

/// "m", "dob", "sil".
[[nodiscard]] std::optional<RelayType> ParseRelayTypeOrNull(std::string_view text);

/// "m", "fb0_di": a block as in the path of val_s32; not si and so.
[[nodiscard]] std::optional<RelayBlock> ParseRelayBlockOrNull(std::string_view text);

/// "ml100", "fb0.di23", also in upper case. Nullopt if invalid or outside its block.
[[nodiscard]] std::optional<RelayName> ParseRelayNameOrNull(std::string_view anyCase);

} // namespace ACS::OpenStreamSim
