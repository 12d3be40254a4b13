#pragma once

#include <acs/core/Result.hpp>
#include <acs/json/JsonDocument.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace ACS::Json
{

/// Deviations that a decoder tolerated, for metrics.
struct DecodeNotes
{
    std::uint32_t unknownMembers = 0;
    std::uint32_t nullOptionals = 0;
    std::uint32_t lenientWords = 0;
    std::uint32_t lenientNumbers = 0;
    std::uint32_t badTimestamps = 0; ///< Of codecs that read past an unreadable time.

    bool operator==(const DecodeNotes&) const = default;
};

struct DecodeOptions
{
    bool bUnknownMembersRefused = false;
    bool bNumericStringsAccepted = false;
    bool bWordsInAnyCase = true;
    std::size_t maximumString = 64U * 1024U; ///< Bytes of a string that its field does not bound.
    std::size_t maximumArray = 10'000;       ///< Elements of an array that its field does not bound.
    std::chrono::minutes assumedOffset{0};   ///< Of a timestamp without one, in codecs that read such.
};

/// The context of a decode: its options, notes and first error. The path of an error is composed from the inside out while
/// the calls return, so that valid messages have no cost.
class DecodeContext
{
    DecodeOptions _options;
    DecodeNotes _notes;
    Core::Error _error;
    std::vector<std::string_view> _unknownNames;

public:
    explicit DecodeContext(const DecodeOptions& options = {});

    [[nodiscard]] const DecodeOptions& GetOptions() const noexcept;
    [[nodiscard]] DecodeNotes& GetNotes() noexcept;
    [[nodiscard]] const Core::Error& GetError() const noexcept;
    [[nodiscard]] Core::Error TakeError();

    /// Always false, so that a decoder can end with `return context.IsFailedWith(…)`. IsFailedAt adds to the path.
    [[nodiscard]] bool IsFailedWith(Core::ECoreError code, std::string expected, const Value* foundOrNull);
    [[nodiscard]] bool IsFailedWith(std::error_code code, std::string expected, std::string found);
    [[nodiscard]] bool IsFailedAt(std::string_view memberName);
    [[nodiscard]] bool IsFailedAt(std::size_t index);

    /// Notes an unknown member; false when it is refused or was named twice.
    [[nodiscard]] bool TryNoteUnknown(std::string_view name, const Value& value, std::size_t firstUnknown);
    [[nodiscard]] std::size_t GetUnknownCount() const noexcept;
    /// Ends an object's unknown members; false when one was named twice.
    [[nodiscard]] bool TryForgetUnknown(std::size_t firstUnknown);
};

/// Fails the decode: the member was named twice. Always false.
[[nodiscard]] bool IsRepeatedMember(std::string_view name, DecodeContext& context);

} // namespace ACS::Json
