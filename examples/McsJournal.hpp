#pragma once

#include "JournalFile.hpp"
#include <acs/protocol/AcsCodec.hpp>
#include <acs/protocol/AcsMessage.hpp>

#include <algorithm>
#include <bitset>
#include <cerrno>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

/// What an MCS must not lose, in a file with one message of the wire in each line: the reports that it has received, the
/// plans that it sends, and the Acks of these plans. The file and the memory only grow; a real MCS has a database.
class McsJournal
{
    using AcsRequest = ACS::Protocol::AcsRequest;
    using EAcsCommand = ACS::Protocol::EAcsCommand;
    using CommandSet = std::bitset<ACS::Protocol::COMMAND_COUNT>;

    JournalFile _file;
    std::set<std::pair<EAcsCommand, std::string>> _reports; ///< Command and transactionID.
    std::vector<AcsRequest> _openPlans;
    std::string _scratch;

public:
    /// The reports that an ACS keeps until they have an Ack. States are sent again in full after each Registration.
    [[nodiscard]] static CommandSet GetReportCommands()
    {
        CommandSet commands;
        for (const EAcsCommand command :
             {EAcsCommand::PlanReport,
              EAcsCommand::StepReport,
              EAcsCommand::JobReport,
              EAcsCommand::CancelResultReport,
              EAcsCommand::AbortResultReport,
              EAcsCommand::PauseResultReport,
              EAcsCommand::ResumeResultReport,
              EAcsCommand::ErrorReport})
        {
            commands.set(static_cast<std::size_t>(command));
        }
        return commands;
    }

    /// False if the file cannot be used, or has a line that is not a message (see errno).
    [[nodiscard]] bool TryOpen(const std::string& path)
    {
        const std::optional<std::vector<std::string>> lines = _file.OpenOrNull(path);
        if (!lines.has_value())
        {
            return false;
        }
        ACS::Protocol::AcsCodec codec;
        return std::ranges::all_of(*lines, [this, &codec](const std::string& line) {
            ACS::Protocol::DecodeOutcome outcome = codec.Decode(line);
            if (!outcome.message.has_value())
            {
                errno = EBADMSG;
                return false;
            }
            Remember(std::move(*outcome.message));
            return true;
        });
    }

    [[nodiscard]] bool HasReport(const AcsRequest& report) const
    {
        return _reports.contains({GetCommand(report), report.transactionID});
    }

    /// A report, a plan or the Ack of a plan. False if it cannot be written (see errno). An Ack ends its plan here even then:
    /// the plan is sent again after a restart only.
    [[nodiscard]] bool TryAdd(ACS::Protocol::AcsMessage message)
    {
        ACS::Protocol::AcsCodec::Encode(message, _scratch);
        const bool bWritten = _file.TryAppend(_scratch);
        if (bWritten || std::holds_alternative<ACS::Protocol::AcsAck>(message))
        {
            Remember(std::move(message));
        }
        return bWritten;
    }

    /// Why the last TryOpen or TryAdd has failed.
    [[nodiscard]] static std::string DescribeFailure()
    {
        return "the journal cannot be used: " + std::generic_category().message(errno);
    }

    /// The plans without an Ack, oldest first. Whether the ACS has received one of them is unknown.
    [[nodiscard]] const std::vector<AcsRequest>& GetOpenPlans() const
    {
        return _openPlans;
    }

private:
    void Remember(ACS::Protocol::AcsMessage message)
    {
        if (const auto* const ackOrNull = std::get_if<ACS::Protocol::AcsAck>(&message); ackOrNull != nullptr)
        {
            std::erase_if(_openPlans, [ackOrNull](const AcsRequest& plan) {
                return plan.transactionID == ackOrNull->transactionID;
            });
            return;
        }
        auto& request = std::get<AcsRequest>(message);
        if (std::holds_alternative<ACS::Protocol::ExecutionPlan>(request.payload))
        {
            _openPlans.push_back(std::move(request));
            return;
        }
        _reports.emplace(GetCommand(request), std::move(request.transactionID));
    }
};
