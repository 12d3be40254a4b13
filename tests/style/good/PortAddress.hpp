#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <variant>
#include <vector>

namespace ACS::Sample
{

enum class EPortKind : std::uint8_t
{
    Cassette,
    Tray,
    Memory,
};

/// Bit flags: the name ends in Flags.
enum class EPortStateFlags : std::uint8_t
{
    None = 0,
    Occupied = 1U << 0U,
    Locked = 1U << 1U,
};

/// A small struct may be declared beside the class that uses it.
struct PortSegment
{
    EPortKind kind = EPortKind::Cassette;
    std::uint32_t number = 0;
    bool bLocked = false;
    std::optional<bool> bOccupied;

    bool operator==(const PortSegment&) const = default;
};

/// Valid by construction: Parse() is the only way in.
class PortAddress final
{
public:
    static constexpr std::size_t MAX_SEGMENTS = 3;

private:
    std::string _ownerID;
    std::vector<PortSegment> _segments;

    PortAddress(std::string ownerID, std::vector<PortSegment> segments);

public:
    /// Parses text from outside. Never throws; fails with ESampleError::Malformed.
    [[nodiscard]] static std::variant<PortAddress, std::error_code> Parse(std::string_view text);

    [[nodiscard]] const std::string& GetOwnerID() const noexcept;
    [[nodiscard]] bool HasPort() const noexcept;
    [[nodiscard]] std::optional<std::uint32_t> GetPortNumberOrNull(EPortKind kind) const;
    [[nodiscard]] const PortSegment* FindSegmentOrNull(EPortKind kind) const;
};

} // namespace ACS::Sample
