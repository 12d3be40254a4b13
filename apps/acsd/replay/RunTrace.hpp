#pragma once

#include "AcsdCore.hpp"
#include "config/AcsdConfig.hpp"
#include "replay/CoreRecorder.hpp"
#include "trace/MessageTrace.hpp"
#include "view/ChangeObserver.hpp"
#include <acs/core/Now.hpp>
#include <acs/plan/IPlanObserver.hpp>

#include <memory>

namespace ACS::Acsd
{

/// What the trace has of a run besides the messages: the decisions of the engine, and what a replay needs. Without a trace it only
/// passes everything on.
class RunTrace final
{
    ChangeObserver _observer;
    std::unique_ptr<CoreRecorder> _recorder; ///< Null without a trace.

public:
    /// Begins the run in the trace, which may be null. The trace outlives it.
    RunTrace(MessageTrace* traceOrNull, const AcsdConfig& config, Core::Now now);

    /// The dependencies to give to the core instead of these. Call it once.
    [[nodiscard]] AcsdCore::Dependencies Wrap(const AcsdCore::Dependencies& real);

    /// For the engine.
    [[nodiscard]] Planning::IPlanObserver& GetObserver() noexcept;
};

} // namespace ACS::Acsd
