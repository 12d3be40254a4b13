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
    ACS::Protocol::AcsSession session;

    acs_acs(const ACS::Protocol::SessionOptions& options, acs_random randomOrNull, void* contextOrNull)
        : SessionHandle(options.codec, randomOrNull, contextOrNull),
          session(options, _random)
    {
    }
};

namespace ACS::CInterface
{

namespace
{

void WriteDefaults(acs_acs_options& options)
{
    const Protocol::SessionOptions defaults;
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
    WriteCodecDefaults(options.codec);
}

Protocol::SessionOptions ReadOptions(const acs_acs_options& options, Arguments& arguments)
{
    Protocol::SessionOptions result;
    arguments.Add(CheckStruct(&options));
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

std::int32_t SendRequest(
    acs_acs& acs,
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
        acs.session.SendStatus(request.payload, now, out);
        return ACS_OK;
    }
    if (const auto* const positionsOrNull = std::get_if<Protocol::RobotPositionUpdate>(&request.payload))
    {
        acs.session.SendPosition(*positionsOrNull, now, out);
        return acs.session.IsRegistered() ? ACS_OK : ACS_ERROR_NOT_READY;
    }
    return acs.session.TrySendDurable(request, now, out) ? ACS_OK : ACS_ERROR_NOT_READY;
}

std::int32_t Send(
    acs_acs& acs,
    std::string_view text,
    acs_message* messageOrNull,
    Core::Now now,
    Protocol::SessionActions& out)
{
    const Protocol::DecodeOutcome outcome = acs.Decode(text, now);
    if (const std::int32_t result = acs.Show(outcome, messageOrNull); result != ACS_OK)
    {
        return result;
    }
    const auto* const requestOrNull = std::get_if<Protocol::AcsRequest>(&*outcome.message);
    return requestOrNull == nullptr ? ACS_ERROR_DIRECTION : SendRequest(acs, *requestOrNull, now, out);
}

std::int32_t Answer(
    acs_acs& acs,
    std::string_view text,
    acs_message* messageOrNull,
    Core::Now now,
    Protocol::SessionActions& out)
{
    const Protocol::DecodeOutcome outcome = acs.Decode(text, now);
    if (const std::int32_t result = acs.Show(outcome, messageOrNull); result != ACS_OK)
    {
        return result;
    }
    const auto* const ackOrNull = std::get_if<Protocol::AcsAck>(&*outcome.message);
    if (ackOrNull == nullptr || !Protocol::IsSentByMCS(ackOrNull->command))
    {
        return ACS_ERROR_DIRECTION;
    }
    const Protocol::AcsAck& ack = *ackOrNull;
    acs.session.Answer(ack.command, ack.transactionID, ack.result, ack.message, ack.payload, now, out);
    return ACS_OK;
}

} // namespace

} // namespace ACS::CInterface

using ACS::CInterface::Arguments;
using ACS::CInterface::CheckStruct;
using ACS::Core::Now;
using ACS::Protocol::SessionActions;

extern "C"
{
    std::int32_t acs_acs_options_init(acs_acs_options* options, std::size_t options_size)
    {
        if (options == nullptr)
        {
            return ACS_ERROR_ARGUMENT;
        }
        if (options_size != sizeof(*options))
        {
            return ACS_ERROR_VERSION;
        }
        ACS::CInterface::WriteDefaults(*options);
        return ACS_OK;
    }

    std::int32_t acs_acs_create(std::uint32_t abi_version, const acs_acs_options* options, acs_acs** acs)
    {
        if (acs == nullptr)
        {
            return ACS_ERROR_ARGUMENT;
        }
        *acs = nullptr;
        if (abi_version != ACS_C_ABI_VERSION)
        {
            return ACS_ERROR_VERSION;
        }
        return ACS::CInterface::Guard([&]() -> std::int32_t {
            Arguments arguments;
            acs_acs_options defaults;
            ACS::CInterface::WriteDefaults(defaults);
            const acs_acs_options& used = options == nullptr ? defaults : *options;
            const ACS::Protocol::SessionOptions sessionOptions = ACS::CInterface::ReadOptions(used, arguments);
            if (arguments.IsValid())
            {
                *acs = std::make_unique<acs_acs>(sessionOptions, used.random, used.random_context).release();
            }
            return arguments.GetResult();
        });
    }

    void acs_acs_destroy(acs_acs* acs)
    {
        const std::unique_ptr<acs_acs> ended(acs);
    }

    std::int32_t acs_acs_start(acs_acs* acs, std::int64_t steady_ms, std::int64_t wall_ms)
    {
        if (acs == nullptr)
        {
            return ACS_ERROR_ARGUMENT;
        }
        return acs->Run({}, {steady_ms, wall_ms}, [&](Now now, SessionActions& out) -> std::int32_t {
            acs->session.Start(now, out);
            return ACS_OK;
        });
    }

    std::int32_t acs_acs_stop(acs_acs* acs, std::int64_t steady_ms, std::int64_t wall_ms)
    {
        if (acs == nullptr)
        {
            return ACS_ERROR_ARGUMENT;
        }
        return acs->Run({}, {steady_ms, wall_ms}, [&](Now now, SessionActions& out) -> std::int32_t {
            acs->session.Stop(now, out);
            return ACS_OK;
        });
    }

    std::int32_t acs_acs_connected(acs_acs* acs, std::int64_t steady_ms, std::int64_t wall_ms)
    {
        if (acs == nullptr)
        {
            return ACS_ERROR_ARGUMENT;
        }
        return acs->Run({}, {steady_ms, wall_ms}, [&](Now now, SessionActions& out) -> std::int32_t {
            acs->session.OnConnected(now, out);
            return ACS_OK;
        });
    }

    std::int32_t acs_acs_received(
        acs_acs* acs,
        const char* text,
        std::size_t length,
        std::int64_t steady_ms,
        std::int64_t wall_ms)
    {
        if (acs == nullptr)
        {
            return ACS_ERROR_ARGUMENT;
        }
        Arguments arguments;
        const std::string_view bytes = arguments.ReadBytes(text, length);
        return acs->Run(arguments, {steady_ms, wall_ms}, [&](Now now, SessionActions& out) -> std::int32_t {
            acs->session.OnText(bytes, now, out);
            return ACS_OK;
        });
    }

    std::int32_t acs_acs_closed(
        acs_acs* acs,
        const char* reason,
        std::size_t reason_length,
        std::int64_t steady_ms,
        std::int64_t wall_ms)
    {
        if (acs == nullptr)
        {
            return ACS_ERROR_ARGUMENT;
        }
        Arguments arguments;
        const std::string_view reasonText = arguments.ReadText(reason, reason_length);
        return acs->Run(arguments, {steady_ms, wall_ms}, [&](Now now, SessionActions& out) -> std::int32_t {
            acs->session.OnClosed(reasonText, now, out);
            return ACS_OK;
        });
    }

    std::int32_t acs_acs_timer_elapsed(acs_acs* acs, std::int32_t timer, std::int64_t steady_ms, std::int64_t wall_ms)
    {
        if (acs == nullptr)
        {
            return ACS_ERROR_ARGUMENT;
        }
        Arguments arguments;
        const ACS::Protocol::ESessionTimer name = arguments.ReadTimer(timer);
        return acs->Run(arguments, {steady_ms, wall_ms}, [&](Now now, SessionActions& out) -> std::int32_t {
            acs->session.OnTimer(name, now, out);
            return ACS_OK;
        });
    }

    std::int32_t acs_acs_send(
        acs_acs* acs,
        const char* text,
        std::size_t length,
        std::int64_t steady_ms,
        std::int64_t wall_ms,
        acs_message* message)
    {
        if (acs == nullptr)
        {
            return ACS_ERROR_ARGUMENT;
        }
        Arguments arguments;
        const std::string_view bytes = arguments.ReadBytes(text, length);
        arguments.Add(message == nullptr ? ACS_OK : CheckStruct(message));
        return acs->Run(arguments, {steady_ms, wall_ms}, [&](Now now, SessionActions& out) -> std::int32_t {
            return ACS::CInterface::Send(*acs, bytes, message, now, out);
        });
    }

    std::int32_t acs_acs_replay_done(acs_acs* acs, std::int64_t steady_ms, std::int64_t wall_ms)
    {
        if (acs == nullptr)
        {
            return ACS_ERROR_ARGUMENT;
        }
        return acs->Run({}, {steady_ms, wall_ms}, [&](Now now, SessionActions& out) -> std::int32_t {
            acs->session.ReplayDone(now, out);
            return ACS_OK;
        });
    }

    std::int32_t acs_acs_answer(
        acs_acs* acs,
        const char* text,
        std::size_t length,
        std::int64_t steady_ms,
        std::int64_t wall_ms,
        acs_message* message)
    {
        if (acs == nullptr)
        {
            return ACS_ERROR_ARGUMENT;
        }
        Arguments arguments;
        const std::string_view bytes = arguments.ReadBytes(text, length);
        arguments.Add(message == nullptr ? ACS_OK : CheckStruct(message));
        return acs->Run(arguments, {steady_ms, wall_ms}, [&](Now now, SessionActions& out) -> std::int32_t {
            return ACS::CInterface::Answer(*acs, bytes, message, now, out);
        });
    }

    std::int32_t acs_acs_next_action(acs_acs* acs, acs_action* action)
    {
        if (const std::int32_t result = CheckStruct(action); result != ACS_OK || acs == nullptr)
        {
            return result == ACS_OK ? ACS_ERROR_ARGUMENT : result;
        }
        return acs->Use([&]() -> std::int32_t {
            acs->TakeAction(*action);
            return ACS_OK;
        });
    }

    std::int32_t acs_acs_get_state(acs_acs* acs, acs_acs_state* state)
    {
        if (const std::int32_t result = CheckStruct(state); result != ACS_OK || acs == nullptr)
        {
            return result == ACS_OK ? ACS_ERROR_ARGUMENT : result;
        }
        return acs->Use([&]() -> std::int32_t {
            state->registered = acs->session.IsRegistered() ? 1 : 0;
            state->room = acs->session.GetRoom();
            state->waiting_actions = acs->GetWaitingCount();
            return ACS_OK;
        });
    }

    std::int32_t acs_acs_set_site_offset(acs_acs* acs, std::int32_t minutes)
    {
        if (acs == nullptr)
        {
            return ACS_ERROR_ARGUMENT;
        }
        return acs->Use([&]() -> std::int32_t {
            Arguments arguments;
            const std::chrono::minutes offset = arguments.ReadOffset(minutes);
            if (arguments.IsValid())
            {
                acs->session.SetSiteOffset(offset);
                acs->SetSiteOffset(offset);
            }
            return arguments.GetResult();
        });
    }

} // extern "C"

// NOLINTEND(readability-identifier-naming)
