#include "ProcessStore.hpp"

#include <acs/plan/EPlanningError.hpp>

#include <utility>

namespace ACS::Simulation
{

using namespace std::chrono_literals;

ProcessStore::ProcessStore(Dependencies around, std::unique_ptr<SimulatedLease> leaseOrNull)
    : _around(std::move(around)),
      _timers(_around.timeline),
      _leaseOrNull(std::move(leaseOrNull))
{
    if (_leaseOrNull != nullptr)
    {
        _leaseOrNull->SetHandlers(
            {[this] {
                 if (!_around.mutator.Is(EMutation::LeaseEndIgnored))
                 {
                     _around.owner.Crash("because its lease has ended");
                 }
             },
             [this] {
                 _around.owner.Crash("after it has released its lease");
             }});
    }
}

void ProcessStore::End()
{
    _timers.CancelAll();
    if (_leaseOrNull != nullptr)
    {
        _leaseOrNull->End();
    }
    if (_writing.has_value() && _around.scenario.bShared)
    {
        LeaveOnItsWay(*_writing);
    }
    else if (_writing.has_value() && _around.chance.IsHit(500))
    {
        _around.trace.Add("acsd: the batch being written is stored");
        if (TryCommit(*_writing).has_value())
        {
            return;
        }
    }
    if (_unsynced.has_value())
    {
        _around.trace.Add("acsd: the commit that failed is stored");
        _around.store.Recover(*std::exchange(_unsynced, std::nullopt));
        _around.onCommit();
    }
}

void ProcessStore::Write(const Planning::StoreBatch& batch)
{
    if (_around.owner.HasCrashed("before a write"))
    {
        return;
    }
    _writing = batch;
    const bool bSlow = _around.scenario.Has(EFault::Disk) && _around.chance.IsHit(30);
    const Core::Duration time = _around.chance.GetBetween(1ms, bSlow ? 3s : 6ms);
    const bool bEarly = _around.mutator.Is(EMutation::StoreConfirmsEarly);
    _timers.Post(bEarly ? time + 300ms : time, [this, bEarly] {
        if (!bEarly)
        {
            Commit();
        }
        else if (_writing.has_value())
        {
            static_cast<void>(TryCommit(*std::exchange(_writing, std::nullopt)));
        }
    });
    if (bEarly)
    {
        // Otherwise the batch before this one would be lost for another reason.
        _timers.Post(0ms, [this] { _around.owner.OnStored({}); });
    }
}

Core::Result<void> ProcessStore::TryCommit(const Planning::StoreBatch& batch)
{
    Core::Result<void> stored = _around.store.Commit(_around.mutator.OnWrite(batch), _around.epoch);
    _around.trace.Add("disk: {} changes {}", batch.changes.size(), stored.has_value() ? "stored" : "refused");
    if (stored.has_value())
    {
        _around.onCommit();
    }
    return stored;
}

/// As LeaderStore: again and again until it is stored, or the lease has ended.
void ProcessStore::CommitShared(Core::Duration retry)
{
    const Core::Result<void> stored = _bCutOff
        ? Core::Fail(Planning::EPlanningError::StoreFailed, "acsd.db", "a connection", "none")
        : TryCommit(*_writing);
    if (!stored.has_value() && stored.error().code != Planning::EPlanningError::StoreTaken)
    {
        _timers.Post(retry, [this, retry] { CommitShared(retry); });
        return;
    }
    _writing.reset();
    if (!_around.owner.HasCrashed("after a write"))
    {
        _around.owner.OnStored(stored);
    }
}

void ProcessStore::Commit()
{
    if (_around.scenario.bShared)
    {
        CommitShared(100ms);
        return;
    }
    const Planning::StoreBatch batch = *std::exchange(_writing, std::nullopt);
    const bool bStored = TryCommit(batch).has_value();
    const bool bUnknown = !bStored && _around.chance.IsHit(300);
    if (bStored || bUnknown)
    {
        _unsynced = bUnknown ? std::optional(_around.mutator.OnWrite(batch)) : std::nullopt;
    }
    if (_around.owner.HasCrashed("after a write"))
    {
        return;
    }
    const bool bConfirmed = bStored || _around.mutator.Is(EMutation::StoreHidesFailure);
    const bool bDenied = !bUnknown || _around.mutator.Is(EMutation::StoreDeniesCommit);
    _around.owner.OnStored(
        bConfirmed ? Core::Result<void>()
                   : Core::Fail(
                       bDenied ? Planning::EPlanningError::StoreFailed : Planning::EPlanningError::StoreOutcomeUnknown,
                       "acsd.db",
                       "room",
                       "disk full"));
    if (bUnknown && _around.scenario.Has(EFault::Crashes) && _around.chance.IsHit(500))
    {
        // Most commits that fail are overwritten by the next attempt.
        _timers.Post(_around.chance.GetBetween(10ms, 3s), [this] {
            if (_unsynced.has_value())
            {
                _around.owner.Crash("after a commit that failed");
            }
        });
    }
}

/// A shared store is another machine: what was sent may arrive much later, or never.
void ProcessStore::LeaveOnItsWay(const Planning::StoreBatch& batch)
{
    if (_around.chance.IsHit(300))
    {
        return;
    }
    const Core::Duration delay = _around.chance.IsHit(300) ? Core::Duration(1ms) : _around.chance.GetBetween(1ms, 12s);
    _around.timeline.Post(
        delay,
        [&store = _around.store,
         &trace = _around.trace,
         epoch = _around.epoch,
         written = _around.mutator.OnWrite(batch),
         onCommit = _around.onCommit] {
            const bool bStored = store.Commit(written, epoch).has_value();
            trace.Add("disk: a batch of epoch {} arrives late: {}", epoch, bStored ? "stored" : "refused");
            if (bStored)
            {
                onCommit();
            }
        });
}

void ProcessStore::CutOff()
{
    _bCutOff = true;
    _leaseOrNull->CutOff();
}

void ProcessStore::Release()
{
    _around.trace.Add("acsd: stops, and releases its lease");
    _leaseOrNull->Release();
}

bool ProcessStore::CanCommand() const
{
    return _leaseOrNull == nullptr || _around.mutator.Is(EMutation::LeaseEndIgnored) || _leaseOrNull->IsHeld();
}

} // namespace ACS::Simulation
