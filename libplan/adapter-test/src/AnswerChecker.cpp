#include "AnswerChecker.hpp"

namespace ACS::AdapterTest
{

AnswerChecker::AnswerChecker(FindingSink sink, Planning::StartJob job)
    : _sink(std::move(sink)),
      _job(std::move(job))
{
}

void AnswerChecker::OnAdapter(const Planning::IRobotAdapter& adapter)
{
    _rejection = adapter.GetRejectionReasonOrNull(_job.action);
}

void AnswerChecker::OnJobCheck(const std::shared_ptr<const Planning::IJobCheck>& checkOrNull)
{
    if (checkOrNull != nullptr)
    {
        _jobChecks.emplace_back(checkOrNull, checkOrNull->GetRejectionReasonOrNull(_job));
    }
}

void AnswerChecker::Verify(const Planning::IRobotAdapter& adapter)
{
    if (adapter.GetRejectionReasonOrNull(_job.action) != _rejection)
    {
        _sink(ERule::ConstantAnswers, "GetRejectionReasonOrNull of the adapter answers another reason than at first.");
    }
    for (const auto& [check, answer] : std::exchange(_jobChecks, {}))
    {
        if (check->GetRejectionReasonOrNull(_job) != answer)
        {
            _sink(ERule::ConstantAnswers, "a job check answers another reason than when it was raised.");
        }
    }
}

} // namespace ACS::AdapterTest
