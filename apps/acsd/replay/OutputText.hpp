#pragma once

#include "replay/CoreRecord.hpp"
#include <acs/plan/EngineAction.hpp>
#include <acs/protocol/AcsMessage.hpp>

#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// The record of a request, a status or a position to the MCS, without its time. Of positions, which are frequent, a hash.
[[nodiscard]] CoreRecord EncodeRequest(std::string_view kind, const Protocol::AcsRequest& request);

/// The record of an answer to the MCS.
[[nodiscard]] CoreRecord EncodeAnswer(const Protocol::AcsAck& ack);

/// The record of a command to a robot.
[[nodiscard]] CoreRecord EncodeRobotCommand(const Planning::CommandRobot& command);

/// The record of a transaction.
[[nodiscard]] CoreRecord EncodeTransaction(const Planning::StoreBatch& batch);

/// JSON of a job without its IDs of this run, by which an answer of a job check is found.
[[nodiscard]] std::string EncodeJob(const Planning::StartJob& job);

} // namespace ACS::Acsd
