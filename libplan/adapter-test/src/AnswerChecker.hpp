#pragma once

#include "FindingSink.hpp"
#include <acs/plan/IRobotAdapter.hpp>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ACS::AdapterTest
{

/// Asks again what must not change.
class AnswerChecker
{
    using Answer = std::optional<std::string>;

    FindingSink _sink;
    Planning::StartJob _job; ///< About which is asked.
    Answer _rejection;       ///< Of the adapter when it was new.
    std::vector<std::pair<std::shared_ptr<const Planning::IJobCheck>, Answer>> _jobChecks;

public:
    AnswerChecker(FindingSink sink, Planning::StartJob job);

    void OnAdapter(const Planning::IRobotAdapter& adapter);
    void OnJobCheck(const std::shared_ptr<const Planning::IJobCheck>& checkOrNull);
    void Verify(const Planning::IRobotAdapter& adapter);
};

} // namespace ACS::AdapterTest
