#include "AcsdService.hpp"

#include "config/LiveConfig.hpp"
#include "operator/AuditLog.hpp"
#include "replay/RecordedConfig.hpp"
#include <acs/plan_postgres/PostgresLease.hpp>

#include <boost/asio/post.hpp>

#include <utility>

namespace ACS::Acsd
{

namespace
{

/// A call of the lease that takes longer is of no use.
constexpr int CALLS_PER_LEASE = 2;

} // namespace

AcsdService::AcsdService(Acsd::Dependencies dependencies, AcsdConfig config, Handlers handlers)
    : _dependencies(std::move(dependencies)),
      _config(std::move(config)),
      _fingerprint(_config.store.postgres.has_value() ? MakeConfigFingerprint(_config) : std::string()),
      _handlers(std::move(handlers)),
      _guard(_leaseClock),
      _addresses(_dependencies.executor, _dependencies.logger, _config.http),
      _standby(
          {[this] { return _keeper->GetWaitReason(); },
           [this] {
               return _keeper->GetPublicReason();
           }})
{
    if (_config.store.postgres.has_value())
    {
        _dependencies.mayCommand = [this] {
            return _guard.IsHeld();
        };
    }
    _dependencies.onStoreTaken = [this](const std::string& reason) {
        // Acsd cannot be destroyed from within its own call.
        boost::asio::post(_dependencies.executor, [this, reason] { LoseStore(reason); });
    };
}

AcsdService::~AcsdService()
{
    _guard.End();
    _opener.join();
}

Core::Result<void> AcsdService::Start()
{
    if (_config.store.postgres.has_value())
    {
        return CheckAuditLog().and_then([this] { return _addresses.Listen(_config.http); }).map([this] {
            BeStandby();
        });
    }
    return OpenDirectoryStore(_config.store)
        .and_then([this](OpenedStore store) { return CreateAcsd(std::move(store)); })
        .and_then([this] { return _addresses.Listen(_config.http); })
        .map([this] { Lead(); });
}

/// So that an error in it is found at the start, and not when this process takes over.
Core::Result<void> AcsdService::CheckAuditLog() const
{
    const OperatorConfig& control = _config.http.control;
    return AuditLog::Create(
               control.auditDirectory,
               control.auditLimits,
               _dependencies.clock,
               _dependencies.logger.MakeFor("audit"))
        .map([](const std::unique_ptr<AuditLog>& /*audit*/) {});
}

void AcsdService::BeStandby()
{
    _state = EState::Standby;
    _keeper = std::make_unique<LeaseKeeper>(
        LeaseKeeper::Dependencies{_dependencies.executor, _leaseClock, _dependencies.logger.MakeFor("lease"), _guard},
        [store = _config.store,
         bMayCreate = _epoch == 0](std::function<bool()> shouldStop) -> std::unique_ptr<Planning::ILease> {
            Planning::PostgresOptions options = *store.postgres;
            options.timeout = store.lease / CALLS_PER_LEASE;
            options.shouldStop = std::move(shouldStop);
            options.bMayCreate = bMayCreate;
            return std::make_unique<Planning::PostgresLease>(std::move(options));
        },
        Planning::LeaseClaim{_config.store.instance, _fingerprint, _config.store.lease},
        LeaseKeeper::Handlers{
            [this](std::uint64_t epoch) { OnTaken(epoch); },
            [this](const std::string& reason) {
                LoseLead(reason);
            }});
    _addresses.SetHandlers(_standby.MakeHandlers());
    _watchdog.emplace(
        _dependencies.executor,
        Apps::LoopWatchdog::Options{_config.operations.stallLimit, _dependencies.aliveInterval},
        Apps::LoopWatchdog::Handlers{{}, _dependencies.onAlive});
    _watchdog->Start();
    _keeper->Start(std::exchange(_pause, {}), std::exchange(_storeFault, {}));
}

/// The lease is renewed while the store is read, however long that takes.
void AcsdService::OnTaken(std::uint64_t epoch)
{
    _state = EState::Opening;
    _epoch = epoch;
    boost::asio::post(_opener, [this, epoch, store = _config.store] {
        auto opened = std::make_shared<Core::Result<OpenedStore>>(OpenSharedStore(store, epoch, _guard));
        boost::asio::post(_dependencies.executor, [this, epoch, opened] { OnOpened(epoch, std::move(*opened)); });
    });
}

void AcsdService::OnOpened(std::uint64_t epoch, Core::Result<OpenedStore> store)
{
    if (_state != EState::Opening || epoch != _epoch)
    {
        return; // the lease was lost, or acsd stops
    }
    if (!store.has_value())
    {
        LoseStore(Core::Describe(store.error()));
        return;
    }
    if (const Core::Result<void> created = CreateAcsd(std::move(*store)); !created.has_value())
    {
        Fail(created.error());
        return;
    }
    _watchdog.reset();
    Lead();
}

Core::Result<void> AcsdService::CreateAcsd(OpenedStore store)
{
    return Acsd::Create(_dependencies, _addresses, _config, std::move(store)).map([this](std::unique_ptr<Acsd> acsd) {
        _acsd = std::move(acsd);
    });
}

void AcsdService::Lead()
{
    _state = EState::Leading;
    _acsd->Start();
}

/// A store that no process can use is not taken several times a second, each time with new connections to all robots.
void AcsdService::LoseStore(const std::string& reason)
{
    if (_config.store.postgres.has_value() && (_state == EState::Opening || _state == EState::Leading))
    {
        _pause = _takeoverPause.OnFault(_leaseClock.GetNow().steady, _config.store.lease);
        _storeFault = reason;
    }
    LoseLead(reason);
}

void AcsdService::LoseLead(const std::string& reason)
{
    _guard.End();
    if (!_config.store.postgres.has_value())
    {
        _dependencies.logger.Error(
            "another program has taken the path of the store: acsd ends now; its own store is where it was moved to",
            {{"reason", reason}});
        _handlers.onFailed();
        return;
    }
    if (_state == EState::Stopping)
    {
        if (std::exchange(_acsd, nullptr) != nullptr)
        {
            Finish();
        }
        return;
    }
    if (_state != EState::Opening && _state != EState::Leading)
    {
        return;
    }
    _dependencies.logger.Error(
        "this process does not lead any more; its connections are closed, and it is a standby",
        {{"reason", reason}});
    _state = EState::Standby;
    _acsd.reset();
    _addresses.SetHandlers(_standby.MakeHandlers());
    // Released, so that this process or another one can take it at once. Not from within a call of the keeper.
    _keeper->ReleaseAsync([this] {
        boost::asio::post(_dependencies.executor, [this] {
            if (_state == EState::Standby)
            {
                BeStandby();
            }
        });
    });
}

void AcsdService::StopAsync()
{
    _state = EState::Stopping;
    if (_acsd != nullptr)
    {
        _acsd->StopAsync([this] { Finish(); });
        return;
    }
    Finish();
}

void AcsdService::Finish()
{
    _addresses.Stop();
    _watchdog.reset();
    if (_keeper == nullptr)
    {
        _handlers.onStopped();
        return;
    }
    _keeper->ReleaseAsync([this] { _handlers.onStopped(); });
}

void AcsdService::Fail(const Core::Error& error) const
{
    _dependencies.logger.Error(
        "acsd ends, because it cannot open again what it had opened",
        {{"reason", Core::Describe(error)}});
    _handlers.onFailed();
}

void AcsdService::Reload(const AcsdConfig& fresh)
{
    if (_acsd != nullptr)
    {
        _acsd->Reload(fresh);
    }
    else
    {
        LogChange(_config, fresh, _dependencies.logger.MakeFor("config"));
        if (_dependencies.traceOrNull != nullptr)
        {
            _dependencies.traceOrNull->SetLimits(fresh.operations.trace);
        }
    }
    ApplyLiveKeys(fresh, _config);
    OperatorConfig& control = _config.http.control;
    _addresses.ReloadTLS(control.tls);
    if (TryReplaceTokens(fresh.http.control, control))
    {
        _dependencies.logger.MakeFor("operator").Info("tokens reloaded", {{"file", control.tokensFile}});
    }
}

const std::vector<Apps::ReadyAddress>& AcsdService::GetAddresses() const noexcept
{
    return _addresses.GetAddresses();
}

} // namespace ACS::Acsd
