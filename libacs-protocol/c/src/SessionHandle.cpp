#include "SessionHandle.hpp"

#include "ShownAction.hpp"
#include <acs/core/Timestamp.hpp>
#include <acs/protocol/AcsMessage.hpp>

#include <iterator>
#include <utility>
#include <variant>

namespace ACS::CInterface
{

SessionHandle::SessionHandle(const Protocol::CodecOptions& codec, acs_random randomOrNull, void* contextOrNull)
    : _codec(codec),
      _siteOffset(codec.siteOffset),
      _random(randomOrNull, contextOrNull)
{
}

Protocol::DecodeOutcome SessionHandle::Decode(std::string_view text, Core::Now now)
{
    Protocol::DecodeOutcome outcome = _codec.Decode(text);
    if (outcome.message.has_value() && outcome.notes.badTimestamps > 0)
    {
        const Core::Timestamp timestamp{now.wall, _siteOffset};
        std::visit([&timestamp](auto& message) { message.timestamp = timestamp; }, *outcome.message);
    }
    return outcome;
}

std::int32_t SessionHandle::Show(const Protocol::DecodeOutcome& outcome, acs_message* messageOrNull)
{
    const std::int32_t result = _shown.Assign(outcome);
    if (messageOrNull != nullptr)
    {
        _shown.Show(*messageOrNull);
    }
    return result;
}

void SessionHandle::TakeAction(acs_action& out)
{
    if (_waiting.empty())
    {
        _taken = Protocol::Connect{};
        ShowAction(_taken, _takenText, out);
        out.type = ACS_ACTION_NONE;
        return;
    }
    _takenText = EncodeDelivered(_waiting.front());
    _taken = std::move(_waiting.front());
    _waiting.pop_front();
    ShowAction(_taken, _takenText, out);
}

std::uint64_t SessionHandle::GetWaitingCount() const noexcept
{
    return _waiting.size();
}

void SessionHandle::SetSiteOffset(std::chrono::minutes offset) noexcept
{
    _siteOffset = offset;
    _codec.SetSiteOffset(offset);
}

void SessionHandle::KeepActions()
{
    _waiting.insert(_waiting.end(), std::make_move_iterator(_new.begin()), std::make_move_iterator(_new.end()));
    _new.clear();
}

} // namespace ACS::CInterface
