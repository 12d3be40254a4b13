#pragma once

#include "Catch.hpp"
#include "plans/SamplePlans.hpp"
#include "SeededRandom.hpp"
#include <acs/core/Uuid.hpp>
#include <acs/protocol_beast/AcsClient.hpp>

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Testing
{

/// A small ACS: accepts every plan and reports it as completed at once, except as set by a test.
class TinyACS final : private ProtocolBeast::ISessionHandler
{
public:
    std::optional<std::string> refusal; ///< Refuses every plan for this reason.
    bool bAcknowledging = true;         ///< False: reports plans without an Ack.
    std::optional<std::size_t>
        cutAfter; ///< Disconnects after this number of plans without answering the last, and returns.
    std::vector<Protocol::AcsPayload> moreReports; ///< After the reports of a plan.
    std::vector<std::string> transactions;         ///< Of the plans that came, in order.

private:
    const Core::IClock& _clock;
    SeededRandom _random{7};
    boost::asio::io_context& _context;
    std::string _url;
    std::unique_ptr<ProtocolBeast::AcsClient> _client;
    std::deque<Protocol::AcsRequest> _outbox;

public:
    TinyACS(boost::asio::io_context& context, const Core::IClock& clock, std::string url)
        : _clock(clock),
          _context(context),
          _url(std::move(url))
    {
    }

    void Connect()
    {
        ProtocolBeast::ClientOptions options;
        options.url = _url;
        auto client =
            ProtocolBeast::AcsClient::Create(_context.get_executor(), _clock, _random, Core::Logger(), options, *this);
        REQUIRE(client.has_value());
        _client = std::move(*client);
        _client->Start();
    }

private:
    void OnSessionEvent(const Protocol::SessionEvent& event) override
    {
        if (std::holds_alternative<Protocol::Registered>(event))
        {
            _client->ReplayDone();
        }
        else if (const auto* const acked = std::get_if<Protocol::Acked>(&event))
        {
            std::erase_if(_outbox, [acked](const auto& request) {
                return request.transactionID == acked->transactionID;
            });
            SendNext();
        }
        else if (const auto* const received = std::get_if<Protocol::RequestReceived>(&event))
        {
            const auto* const cancelOrNull = std::get_if<Protocol::CancelPlan>(&received->request.payload);
            if (std::holds_alternative<Protocol::ExecutionPlan>(received->request.payload))
            {
                OnPlan(received->request);
            }
            else if (cancelOrNull != nullptr)
            {
                _client->Answer(
                    Protocol::EAcsCommand::CancelPlan,
                    received->request.transactionID,
                    Protocol::EAckResult::Success,
                    "in progress",
                    Protocol::PlanAck{cancelOrNull->planID});
                Queue(Protocol::CancelResultReport{
                    cancelOrNull->planID,
                    Protocol::EReportResult::Failed,
                    "the plan has ended"});
                SendNext();
            }
        }
    }

    void OnPlan(const Protocol::AcsRequest& request)
    {
        const auto& plan = std::get<Protocol::ExecutionPlan>(request.payload);
        transactions.push_back(request.transactionID);
        if (cutAfter == transactions.size())
        {
            // Later: this is called by the client that is destroyed.
            boost::asio::post(_context, [this] {
                _client.reset();
                Connect();
            });
            return;
        }
        if (bAcknowledging)
        {
            _client->Answer(
                Protocol::EAcsCommand::ExecutionPlan,
                request.transactionID,
                refusal.has_value() ? Protocol::EAckResult::Fail : Protocol::EAckResult::Success,
                refusal.value_or(""),
                Protocol::PlanAck{plan.planID});
        }
        if (!refusal.has_value())
        {
            ReportAll(plan);
            SendNext();
        }
    }

    /// The steps of a sample plan are not in order.
    void ReportAll(const Protocol::ExecutionPlan& plan)
    {
        const std::string& planID = plan.planID;
        Queue(MakePlanReport(planID, Protocol::EPlanStatus::InProgress));
        const auto& last = plan.steps.at(0).jobs;
        const std::vector<std::vector<std::string>> jobs{
            {plan.steps.at(1).jobs.at(0).jobID},
            {last.at(0).jobID, last.at(1).jobID}};
        for (std::int32_t stepNo = 1; stepNo <= 2; ++stepNo)
        {
            Queue(MakeStepReport(planID, stepNo, Protocol::EStepStatus::Dispatched));
            Queue(MakeStepReport(planID, stepNo, Protocol::EStepStatus::InProgress));
            for (const std::string& jobID : jobs[static_cast<std::size_t>(stepNo - 1)])
            {
                for (const Protocol::EJobStatus status :
                     {Protocol::EJobStatus::Instructed,
                      Protocol::EJobStatus::InProgress,
                      Protocol::EJobStatus::Completed})
                {
                    Queue(MakeJobReport(planID, stepNo, jobID, status));
                }
            }
            Queue(MakeStepReport(planID, stepNo, Protocol::EStepStatus::Completed));
        }
        Queue(MakePlanReport(planID, Protocol::EPlanStatus::Completed));
        for (const Protocol::AcsPayload& report : moreReports)
        {
            Queue(report);
        }
    }

    void Queue(Protocol::AcsPayload payload)
    {
        _outbox.push_back({Core::MakeUUID(_random), {_clock.GetNow().wall, {}}, std::move(payload)});
    }

    void SendNext()
    {
        for (const Protocol::AcsRequest& request : _outbox)
        {
            if (!_client->TrySendDurable(request))
            {
                return;
            }
        }
    }
};

} // namespace ACS::Testing
