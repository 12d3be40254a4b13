#pragma once

#include <chrono>
#include <filesystem>
#include <string>

namespace ACS::Testing
{

/// A certificate and its key on disk.
struct CertificateFiles
{
    std::string certificate;
    std::string key;
};

/// What a certificate is to say.
struct CertificateRequest
{
    std::string alternativeName = "DNS:localhost,IP:127.0.0.1"; ///< As OpenSSL's configuration writes it.
    std::chrono::hours validFrom{-24};                          ///< From now.
    std::chrono::hours validTo{24};
    bool bRSA = false;
    std::string passphrase; ///< Of the key file; empty: none.
};

/// Makes certificates at test time, into a folder that it is given: none is kept in the repository, none grows old.
class CertificateMaker
{
    std::filesystem::path _folder;
    int _count = 0;

public:
    explicit CertificateMaker(std::filesystem::path folder);

    [[nodiscard]] CertificateFiles MakeCA(const std::string& name);
    [[nodiscard]] CertificateFiles Make(const CertificateFiles& ca, const CertificateRequest& wish);
    [[nodiscard]] CertificateFiles MakeSelfSigned(const CertificateRequest& wish);

    /// A file with this text; its path.
    [[nodiscard]] std::string WriteFile(const std::string& name, const std::string& text) const;
};

} // namespace ACS::Testing
