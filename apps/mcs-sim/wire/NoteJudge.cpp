#include "wire/NoteJudge.hpp"

#include "console/CleanText.hpp"
#include <acs/protocol/AcsCodec.hpp>

#include <fmt/format.h>

#include <variant>

namespace ACS::McsSim
{

using Protocol::EProtocolNote;

namespace
{

struct NoteRule
{
    EProtocolNote note;
    EBlame blame;
    std::string_view meaning;
};

/// The document's own examples spell words in several ways and repeat members (D-1 to D-3, D-27): deviations. What breaks a
/// rule that it states is a fault.
constexpr std::array<NoteRule, Protocol::NOTE_COUNT> RULES{
    {{EProtocolNote::UnknownMember, EBlame::Deviation, "member that the document does not have"},
     {EProtocolNote::NullOptional, EBlame::Deviation, "null where a member is left out"},
     {EProtocolNote::LenientWord, EBlame::Deviation, "word in another case than the document's"},
     {EProtocolNote::LenientNumber, EBlame::Deviation, "number written as a text"},
     {EProtocolNote::BadTimestamp, EBlame::Fault, "missing or unreadable timestamp"},
     {EProtocolNote::Undecodable, EBlame::BadAnswer, "unreadable message"},
     {EProtocolNote::UnknownCommand, EBlame::Fault, "command that an ACS does not send"},
     {EProtocolNote::AckMismatched, EBlame::BadAnswer, "Ack with a foreign transactionId"},
     {EProtocolNote::AckUnexpected, EBlame::BadAnswer, "Ack of nothing that was asked"},
     {EProtocolNote::AckFailed, EBlame::None, "report refused by the MCS"},
     {EProtocolNote::DuplicateRequest, EBlame::None, "repeated request"},
     {EProtocolNote::BeforeRegistered, EBlame::Fault, "message before the registration"},
     {EProtocolNote::RegistrationUnanswered, EBlame::None, "registration without an answer"}}};

constexpr bool IsTableInOrder()
{
    for (std::size_t i = 0; i < RULES.size(); ++i)
    {
        if (static_cast<std::size_t>(RULES[i].note) != i)
        {
            return false;
        }
    }
    return true;
}

static_assert(IsTableInOrder(), "the table is indexed by the enumerator");

const NoteRule& GetRule(EProtocolNote note)
{
    return RULES[static_cast<std::size_t>(note)];
}

/// The public MCS does not know positions. The session notes this as a deviation of the ACS, although it is one of the MCS.
bool IsOfProfile(const Protocol::ProtocolNoted& noted)
{
    return noted.what == EProtocolNote::UnknownCommand
        && noted.detail == GetText(Protocol::EAcsCommand::RobotPositionUpdate);
}

bool IsAnswerable(const Protocol::DecodeOutcome& outcome)
{
    return outcome.message.has_value() ? std::holds_alternative<Protocol::AcsRequest>(*outcome.message)
                                       : !outcome.message.error().commandName.empty() && !outcome.message.error().bAck;
}

} // namespace

EBlame GetBlame(EProtocolNote note)
{
    return GetRule(note).blame;
}

std::string_view GetMeaning(EProtocolNote note)
{
    return GetRule(note).meaning;
}

void NoteJudge::Excuse() noexcept
{
    ++_excuses;
}

void NoteJudge::WithdrawExcuse() noexcept
{
    _excuses -= _excuses > 0 ? 1U : 0U;
}

void NoteJudge::OnTextSent(std::string_view text)
{
    if (IsAnswerable(Protocol::AcsCodec().Decode(text)))
    {
        Excuse();
    }
}

std::optional<NoteJudge::Verdict> NoteJudge::JudgeOrNull(const Protocol::ProtocolNoted& noted)
{
    const EBlame blame = GetBlame(noted.what);
    if (blame == EBlame::None || IsOfProfile(noted))
    {
        return std::nullopt;
    }
    const bool bExcused = blame == EBlame::BadAnswer && _excuses > 0;
    _excuses -= bExcused ? 1U : 0U;
    std::uint64_t& count = _counts[static_cast<std::size_t>(noted.what)];
    const bool bFirst = count == 0;
    count += bExcused ? 0U : noted.count;
    if (blame == EBlame::Deviation && !bFirst)
    {
        return std::nullopt;
    }
    std::string text = fmt::format("ACS {}", GetMeaning(noted.what));
    text += noted.detail.empty() ? "" : ": " + CleanText(noted.detail);
    if (blame == EBlame::Deviation)
    {
        return Verdict{text + " (reported once)", false};
    }
    return Verdict{text + (bExcused ? " (as asked for)" : ""), !bExcused};
}

const NoteCounts& NoteJudge::GetCounts() const noexcept
{
    return _counts;
}

} // namespace ACS::McsSim
