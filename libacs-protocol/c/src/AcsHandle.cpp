#include "SessionCalls.hpp"
#include "SessionHandle.hpp"
#include <acs/c/acs_protocol.h>
#include <acs/protocol/AcsSession.hpp>
#include <acs/protocol/SessionOptions.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <variant>

// NOLINTBEGIN(readability-identifier-naming): the names of a C interface

struct acs_acs : ACS::CInterface::SessionHandle
{
    using Options = acs_acs_options;

    ACS::Protocol::AcsSession session;

    acs_acs(const ACS::Protocol::SessionOptions& options, acs_random randomOrNull, void* contextOrNull)
        : SessionHandle(options.codec, randomOrNull, contextOrNull),
          session(options, _random)
    {
    }

    static void WriteDefaults(Options& options);
    [[nodiscard]] static ACS::Protocol::SessionOptions ReadOptions(
        const Options& options,
        ACS::CInterface::Arguments& arguments);
};

namespace ACS::CInterface
{

namespace
{

std::int32_t SendRequest(
    Protocol::AcsSession& session,
    const Protocol::AcsRequest& request,
    Core::Now now,
    Protocol::SessionActions& out)
{
    const Protocol::EAcsCommand command = Protocol::GetCommand(request);
    if (Protocol::IsSentByMCS(command) || command == Protocol::EAcsCommand::Registration)
    {
        return ACS_ERROR_DIRECTION;
    }
    if (command == Protocol::EAcsCommand::TscStateUpdate || command == Protocol::EAcsCommand::AcsCommStateUpdate
        || command == Protocol::EAcsCommand::RobotStatusUpdate)
    {
        session.SendStatus(request.payload, now, out);
        return ACS_OK;
    }
    if (const auto* const positionsOrNull = std::get_if<Protocol::RobotPositionUpdate>(&request.payload))
    {
        session.SendPosition(*positionsOrNull, now, out);
        return session.IsRegistered() ? ACS_OK : ACS_ERROR_NOT_READY;
    }
    return session.TrySendDurable(request, now, out) ? ACS_OK : ACS_ERROR_NOT_READY;
}

std::int32_t SendAnswer(
    Protocol::AcsSession& session,
    const Protocol::AcsAck& ack,
    Core::Now now,
    Protocol::SessionActions& out)
{
    if (!Protocol::IsSentByMCS(ack.command))
    {
        return ACS_ERROR_DIRECTION;
    }
    session.Answer(ack.command, ack.transactionID, ack.result, ack.message, ack.payload, now, out);
    return ACS_OK;
}

} // namespace

} // namespace ACS::CInterface

void acs_acs::WriteDefaults(Options& options)
{
    const ACS::Protocol::SessionOptions defaults;
    options = {};
    options.struct_size = sizeof(options);
    options.ack_retries = static_cast<std::uint32_t>(defaults.ackRetries);
    options.ack_dead_after = static_cast<std::uint32_t>(defaults.ackDeadAfter);
    options.window = static_cast<std::uint32_t>(defaults.window);
    options.ack_timeout_ms = defaults.ackTimeout.count();
    options.position_interval_ms = defaults.positionInterval.count();
    options.answer_memory_ms = defaults.answerMemory.count();
    options.shutdown_grace_ms = defaults.shutdownGrace.count();
    options.reconnect_initial_ms = defaults.reconnect.initial.count();
    options.reconnect_max_ms = defaults.reconnect.maximum.count();
    options.answer_bytes = defaults.answerBytes;
    options.answer_count = static_cast<std::uint32_t>(defaults.answerCount);
    options.match_acks_by_command = defaults.bAcksMatchedByCommand ? 1 : 0;
    ACS::CInterface::WriteCodecDefaults(options.codec);
}

ACS::Protocol::SessionOptions acs_acs::ReadOptions(const Options& options, ACS::CInterface::Arguments& arguments)
{
    ACS::Protocol::SessionOptions result;
    arguments.Add(ACS::CInterface::CheckStruct(&options));
    if (!arguments.IsValid())
    {
        return result;
    }
    result.ackRetries = arguments.ReadCount(options.ack_retries, 0, ACS_COUNT_MAX);
    result.ackDeadAfter = arguments.ReadCount(options.ack_dead_after, 1, ACS_COUNT_MAX);
    result.window = arguments.ReadCount(options.window, 1, ACS_COUNT_MAX);
    result.ackTimeout = arguments.ReadDuration(options.ack_timeout_ms, 1);
    result.positionInterval = arguments.ReadDuration(options.position_interval_ms, 0);
    result.answerMemory = arguments.ReadDuration(options.answer_memory_ms, 1);
    result.shutdownGrace = arguments.ReadDuration(options.shutdown_grace_ms, 1);
    result.reconnect.initial = arguments.ReadDuration(options.reconnect_initial_ms, 1);
    result.reconnect.maximum = arguments.ReadDuration(options.reconnect_max_ms, options.reconnect_initial_ms);
    result.answerBytes = arguments.ReadCount(options.answer_bytes, 0, ACS_SIZE_MAX);
    result.answerCount = arguments.ReadCount(options.answer_count, 1, ACS_COUNT_MAX);
    result.bAcksMatchedByCommand = options.match_acks_by_command != 0;
    result.codec = arguments.ReadCodecOptions(options.codec);
    const bool bReservedEmpty = std::ranges::all_of(options.reserved, [](std::uint8_t byte) { return byte == 0; });
    arguments.Add(bReservedEmpty ? ACS_OK : ACS_ERROR_ARGUMENT);
    return result;
}

using ACS::CInterface::Arguments;
using ACS::CInterface::CallSession;
using ACS::CInterface::FillStruct;
using ACS::CInterface::SendMessage;
using ACS::Protocol::AcsSession;

extern "C"
{
    std::int32_t acs_acs_options_init(acs_acs_options* options, std::size_t options_size)
    {
        return ACS::CInterface::InitOptions(options, options_size, acs_acs::WriteDefaults);
    }

    std::int32_t acs_acs_create(std::uint32_t abi_version, const acs_acs_options* options, acs_acs** acs)
    {
        return ACS::CInterface::CreateHandle(abi_version, options, acs);
    }

    void acs_acs_destroy(acs_acs* acs)
    {
        const std::unique_ptr<acs_acs> ended(acs);
    }

    std::int32_t acs_acs_start(acs_acs* acs, std::int64_t steady_ms, std::int64_t wall_ms)
    {
        return CallSession(acs, {}, {steady_ms, wall_ms}, &AcsSession::Start);
    }

    std::int32_t acs_acs_stop(acs_acs* acs, std::int64_t steady_ms, std::int64_t wall_ms)
    {
        return CallSession(acs, {}, {steady_ms, wall_ms}, &AcsSession::Stop);
    }

    std::int32_t acs_acs_connected(acs_acs* acs, std::int64_t steady_ms, std::int64_t wall_ms)
    {
        return CallSession(acs, {}, {steady_ms, wall_ms}, &AcsSession::OnConnected);
    }

    std::int32_t acs_acs_received(
        acs_acs* acs,
        const char* text,
        std::size_t length,
        std::int64_t steady_ms,
        std::int64_t wall_ms)
    {
        Arguments arguments;
        const std::string_view bytes = arguments.ReadBytes(text, length);
        return CallSession(acs, arguments, {steady_ms, wall_ms}, &AcsSession::OnText, bytes);
    }

    std::int32_t acs_acs_closed(
        acs_acs* acs,
        const char* reason,
        std::size_t reason_length,
        std::int64_t steady_ms,
        std::int64_t wall_ms)
    {
        Arguments arguments;
        const std::string_view reasonText = arguments.ReadText(reason, reason_length);
        return CallSession(acs, arguments, {steady_ms, wall_ms}, &AcsSession::OnClosed, reasonText);
    }

    std::int32_t acs_acs_timer_elapsed(acs_acs* acs, std::int32_t timer, std::int64_t steady_ms, std::int64_t wall_ms)
    {
        Arguments arguments;
        const ACS::Protocol::ESessionTimer name = arguments.ReadTimer(timer);
        return CallSession(acs, arguments, {steady_ms, wall_ms}, &AcsSession::OnTimer, name);
    }

    std::int32_t acs_acs_send(
        acs_acs* acs,
        const char* text,
        std::size_t length,
        std::int64_t steady_ms,
        std::int64_t wall_ms,
        acs_message* message)
    {
        return SendMessage<ACS::Protocol::AcsRequest>(
            acs,
            text,
            length,
            {steady_ms, wall_ms},
            message,
            ACS::CInterface::SendRequest);
    }

    std::int32_t acs_acs_replay_done(acs_acs* acs, std::int64_t steady_ms, std::int64_t wall_ms)
    {
        return CallSession(acs, {}, {steady_ms, wall_ms}, &AcsSession::ReplayDone);
    }

    std::int32_t acs_acs_answer(
        acs_acs* acs,
        const char* text,
        std::size_t length,
        std::int64_t steady_ms,
        std::int64_t wall_ms,
        acs_message* message)
    {
        return SendMessage<ACS::Protocol::AcsAck>(
            acs,
            text,
            length,
            {steady_ms, wall_ms},
            message,
            ACS::CInterface::SendAnswer);
    }

    std::int32_t acs_acs_next_action(acs_acs* acs, acs_action* action)
    {
        return FillStruct(acs, action, [&](acs_action& filled) { acs->TakeAction(filled); });
    }

    std::int32_t acs_acs_get_state(acs_acs* acs, acs_acs_state* state)
    {
        return FillStruct(acs, state, [&](acs_acs_state& filled) {
            filled.registered = acs->session.IsRegistered() ? 1 : 0;
            filled.room = acs->session.GetRoom();
            filled.waiting_actions = acs->GetWaitingCount();
        });
    }

    std::int32_t acs_acs_set_site_offset(acs_acs* acs, std::int32_t minutes)
    {
        return ACS::CInterface::SetSiteOffset(acs, minutes);
    }

} // extern "C"

// NOLINTEND(readability-identifier-naming)
