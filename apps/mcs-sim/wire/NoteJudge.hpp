#pragma once

#include <acs/protocol/SessionEvent.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::McsSim
{

/// What the ACS's part in a note is.
enum class EBlame : std::uint8_t
{
    None,      ///< Nothing of the ACS's, or only noted on its side of a link.
    Deviation, ///< Tolerated, but not as specified: reported once per kind, then only counted.
    Fault,     ///< A violation.
    BadAnswer, ///< A violation, unless what was sent asked for it: a text that is no message of this session.
};

[[nodiscard]] EBlame GetBlame(Protocol::EProtocolNote note);
/// For people: "member that the document does not have"; never empty.
[[nodiscard]] std::string_view GetMeaning(Protocol::EProtocolNote note);

/// By EProtocolNote.
using NoteCounts = std::array<std::uint64_t, Protocol::NOTE_COUNT>;

/// Decides for each deviation that the session tolerated or discarded whether it is a fault of the ACS. Pure.
class NoteJudge
{
public:
    /// A line for people, and whether it is a violation.
    struct Verdict
    {
        std::string text;
        bool bViolation = false;

        bool operator==(const Verdict&) const = default;
    };

private:
    std::size_t _excuses = 0;
    NoteCounts _counts{};

public:
    /// One answer that fits nothing will come through no fault of the ACS: a request was abandoned, of which the Ack may
    /// still come, or a message was cut on purpose.
    void Excuse() noexcept;

    /// The late Ack came and was recognised: it needs no excuse.
    void WithdrawExcuse() noexcept;

    /// A text was sent past the session. Where it can be answered, that is excused, as the session will not know the Ack.
    void OnTextSent(std::string_view text);

    /// Nullopt: only counted.
    [[nodiscard]] std::optional<Verdict> JudgeOrNull(const Protocol::ProtocolNoted& noted);

    /// Faults and deviations of the ACS, without excused ones.
    [[nodiscard]] const NoteCounts& GetCounts() const noexcept;
};

} // namespace ACS::McsSim
