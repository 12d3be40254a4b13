#include "SessionCalls.hpp"
#include "SessionHandle.hpp"
#include <acs/c/acs_protocol.h>
#include <acs/protocol/McsSession.hpp>
#include <acs/protocol/SessionOptions.hpp>

#include <algorithm>
#include <bitset>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <variant>

// NOLINTBEGIN(readability-identifier-naming): the names of a C interface

struct acs_mcs : ACS::CInterface::SessionHandle
{
    using Options = acs_mcs_options;

    ACS::Protocol::McsSession session;
    ACS::Protocol::ConnectionID lastConnection = 0;

    acs_mcs(const ACS::Protocol::McsSessionOptions& options, acs_random randomOrNull, void* contextOrNull)
        : SessionHandle(options.codec, randomOrNull, contextOrNull),
          session(options, _random)
    {
    }

    static void WriteDefaults(Options& options);
    [[nodiscard]] static ACS::Protocol::McsSessionOptions ReadOptions(
        const Options& options,
        ACS::CInterface::Arguments& arguments);
};

namespace ACS::CInterface
{

namespace
{

std::optional<Protocol::EAcsCommand> FindCommandOrNull(std::string_view name)
{
    for (std::size_t index = 0; index < Protocol::COMMAND_COUNT; ++index)
    {
        const auto command = static_cast<Protocol::EAcsCommand>(index);
        if (Protocol::GetText(command) == name)
        {
            return command;
        }
    }
    return std::nullopt;
}

/// Names of commands, separated by a space each.
std::bitset<Protocol::COMMAND_COUNT> ReadCommands(const acs_text& names, Arguments& arguments)
{
    std::bitset<Protocol::COMMAND_COUNT> commands;
    std::string_view rest = names.data == nullptr ? std::string_view() : arguments.ReadText(names.data, names.length);
    while (!rest.empty())
    {
        const std::size_t end = std::min(rest.find(' '), rest.size());
        const std::optional<Protocol::EAcsCommand> commandOrNull = FindCommandOrNull(rest.substr(0, end));
        const bool bAnswered =
            commandOrNull.has_value() && !Protocol::IsSentByMCS(*commandOrNull) && Protocol::HasAck(*commandOrNull);
        if (!bAnswered)
        {
            arguments.Add(ACS_ERROR_ARGUMENT);
            return commands;
        }
        commands.set(static_cast<std::size_t>(*commandOrNull));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return commands;
}

std::int32_t SendRequest(
    Protocol::McsSession& session,
    const Protocol::AcsRequest& request,
    Core::Now now,
    Protocol::SessionActions& out)
{
    if (!Protocol::IsSentByMCS(Protocol::GetCommand(request)))
    {
        return ACS_ERROR_DIRECTION;
    }
    return session.TrySend(request, now, out) ? ACS_OK : ACS_ERROR_NOT_READY;
}

} // namespace

} // namespace ACS::CInterface

void acs_mcs::WriteDefaults(Options& options)
{
    const ACS::Protocol::McsSessionOptions defaults;
    options = {};
    options.struct_size = sizeof(options);
    options.ack_timeout_ms = defaults.ackTimeout.count();
    options.answer_timeout_ms = defaults.answerTimeout.count();
    options.registration_timeout_ms = defaults.registrationTimeout.count();
    options.answer_bytes = defaults.answerBytes;
    options.ack_retries = static_cast<std::uint32_t>(defaults.ackRetries);
    options.max_pending = static_cast<std::uint32_t>(defaults.maximumPending);
    options.duplicate_memory = static_cast<std::uint32_t>(defaults.duplicateMemory);
    options.max_unanswered = static_cast<std::uint32_t>(defaults.maximumUnanswered);
    options.silent_if_unanswered = defaults.unansweredPolicy == ACS::Protocol::EUnansweredPolicy::Silence ? 1 : 0;
    options.withhold_plans = defaults.bPlansWithheld ? 1 : 0;
    options.refuse_second = defaults.bSecondRefused ? 1 : 0;
    ACS::CInterface::WriteCodecDefaults(options.codec);
}

ACS::Protocol::McsSessionOptions acs_mcs::ReadOptions(const Options& options, ACS::CInterface::Arguments& arguments)
{
    ACS::Protocol::McsSessionOptions result;
    arguments.Add(ACS::CInterface::CheckStruct(&options));
    if (!arguments.IsValid())
    {
        return result;
    }
    result.ackTimeout = arguments.ReadDuration(options.ack_timeout_ms, 1);
    result.answerTimeout = arguments.ReadDuration(options.answer_timeout_ms, 1);
    result.registrationTimeout = arguments.ReadDuration(options.registration_timeout_ms, 1);
    result.answerBytes = arguments.ReadCount(options.answer_bytes, 0, ACS_SIZE_MAX);
    result.ackRetries = arguments.ReadCount(options.ack_retries, 0, ACS_COUNT_MAX);
    result.maximumPending = arguments.ReadCount(options.max_pending, 1, ACS_COUNT_MAX);
    result.duplicateMemory = arguments.ReadCount(options.duplicate_memory, 1, ACS_COUNT_MAX);
    result.maximumUnanswered = arguments.ReadCount(options.max_unanswered, 1, ACS_COUNT_MAX);
    result.unansweredPolicy = options.silent_if_unanswered != 0 ? ACS::Protocol::EUnansweredPolicy::Silence
                                                                : ACS::Protocol::EUnansweredPolicy::Fail;
    result.bPlansWithheld = options.withhold_plans != 0;
    result.bSecondRefused = options.refuse_second != 0;
    result.answeredByApplication = ACS::CInterface::ReadCommands(options.answered_commands, arguments);
    result.codec = arguments.ReadCodecOptions(options.codec);
    arguments.Add(options.reserved == 0 ? ACS_OK : ACS_ERROR_ARGUMENT);
    return result;
}

using ACS::CInterface::Arguments;
using ACS::CInterface::CallSession;
using ACS::CInterface::FillStruct;
using ACS::CInterface::SendMessage;
using ACS::Core::Now;
using ACS::Protocol::McsSession;
using ACS::Protocol::SessionActions;

extern "C"
{
    std::int32_t acs_mcs_options_init(acs_mcs_options* options, std::size_t options_size)
    {
        return ACS::CInterface::InitOptions(options, options_size, acs_mcs::WriteDefaults);
    }

    std::int32_t acs_mcs_create(std::uint32_t abi_version, const acs_mcs_options* options, acs_mcs** mcs)
    {
        return ACS::CInterface::CreateHandle(abi_version, options, mcs);
    }

    void acs_mcs_destroy(acs_mcs* mcs)
    {
        const std::unique_ptr<acs_mcs> ended(mcs);
    }

    std::int32_t acs_mcs_connected(acs_mcs* mcs, std::uint64_t connection, std::int64_t steady_ms, std::int64_t wall_ms)
    {
        Arguments arguments;
        arguments.Add(mcs == nullptr || connection <= mcs->lastConnection ? ACS_ERROR_ARGUMENT : ACS_OK);
        return CallSession(mcs, arguments, {steady_ms, wall_ms}, [&](auto& session, Now now, SessionActions& out) {
            mcs->lastConnection = connection;
            session.OnConnected(connection, now, out);
        });
    }

    std::int32_t acs_mcs_received(
        acs_mcs* mcs,
        std::uint64_t connection,
        const char* text,
        std::size_t length,
        std::int64_t steady_ms,
        std::int64_t wall_ms)
    {
        Arguments arguments;
        const std::string_view bytes = arguments.ReadBytes(text, length);
        return CallSession(mcs, arguments, {steady_ms, wall_ms}, &McsSession::OnText, connection, bytes);
    }

    std::int32_t acs_mcs_closed(
        acs_mcs* mcs,
        std::uint64_t connection,
        const char* reason,
        std::size_t reason_length,
        std::int64_t steady_ms,
        std::int64_t wall_ms)
    {
        Arguments arguments;
        const std::string_view reasonText = arguments.ReadText(reason, reason_length);
        return CallSession(mcs, arguments, {steady_ms, wall_ms}, &McsSession::OnClosed, connection, reasonText);
    }

    std::int32_t acs_mcs_timer_elapsed(acs_mcs* mcs, std::int32_t timer, std::int64_t steady_ms, std::int64_t wall_ms)
    {
        Arguments arguments;
        const ACS::Protocol::ESessionTimer name = arguments.ReadTimer(timer);
        return CallSession(mcs, arguments, {steady_ms, wall_ms}, &McsSession::OnTimer, name);
    }

    std::int32_t acs_mcs_send(
        acs_mcs* mcs,
        const char* text,
        std::size_t length,
        std::int64_t steady_ms,
        std::int64_t wall_ms,
        acs_message* message)
    {
        return SendMessage<ACS::Protocol::AcsRequest>(
            mcs,
            text,
            length,
            {steady_ms, wall_ms},
            message,
            ACS::CInterface::SendRequest);
    }

    std::int32_t acs_mcs_answer(
        acs_mcs* mcs,
        std::uint64_t token,
        std::int32_t result,
        const char* text,
        std::size_t text_length,
        std::int64_t steady_ms,
        std::int64_t wall_ms)
    {
        Arguments arguments;
        const ACS::Protocol::EAckResult ackResult = arguments.ReadAckResult(result);
        const std::string_view note = arguments.ReadText(text, text_length);
        return CallSession(
            mcs,
            arguments,
            {steady_ms, wall_ms},
            [&](auto& session, Now now, SessionActions& out) -> std::int32_t {
                return session.TryAnswer(token, ackResult, note, now, out) ? ACS_OK : ACS_ERROR_NOT_WAITING;
            });
    }

    std::int32_t acs_mcs_next_action(acs_mcs* mcs, acs_action* action)
    {
        return FillStruct(mcs, action, [&](acs_action& filled) { mcs->TakeAction(filled); });
    }

    std::int32_t acs_mcs_get_state(acs_mcs* mcs, acs_mcs_state* state)
    {
        return FillStruct(mcs, state, [&](acs_mcs_state& filled) {
            const ACS::Protocol::McsSession& session = mcs->session;
            filled.registered = session.IsRegistered() ? 1 : 0;
            filled.takes_plans = session.IsTakingPlans() ? 1 : 0;
            filled.refuses_upgrade = session.ShouldRefuseUpgrade() ? 1 : 0;
            filled.connection = session.GetRegisteredOrNull().value_or(0);
            filled.pending = session.GetPendingCount();
            filled.unanswered = session.GetUnansweredCount();
            filled.waiting_actions = mcs->GetWaitingCount();
        });
    }

    std::int32_t acs_mcs_set_site_offset(acs_mcs* mcs, std::int32_t minutes)
    {
        return ACS::CInterface::SetSiteOffset(mcs, minutes);
    }

} // extern "C"

// NOLINTEND(readability-identifier-naming)
