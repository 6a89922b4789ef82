// A Slurm of one node for a test: munged, slurmctld and slurmd as the test's own processes, in a
// folder of its own, on the loopback address. They end with it.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <pwd.h>
#include <sys/prctl.h>
#include <sys/socket.h>

#include <chrono>
#include <optional>
#include <random>
#include <thread>

#include "tests/cli/program.h"

namespace rotorub::test {

// A command that is started with a folder to write to, and killed at the end.
class Daemon {
 public:
  Daemon(std::vector<std::string> words, const std::filesystem::path& log) {
    process_ = fork();
    if (process_ != 0) return;
    prctl(PR_SET_PDEATHSIG, SIGTERM);  // a test that crashes leaves none behind
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const int out = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(out, 1);
    dup2(out, 2);
    execv(argv[0], argv.data());
    _exit(127);
  }
  ~Daemon() {
    kill(process_, SIGTERM);
    waitpid(process_, nullptr, 0);
  }
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;

 private:
  pid_t process_ = -1;
};

class SlurmCluster {
 public:
  // The first of these programs that is missing; empty if none is.
  static std::string missing() {
    for (const char* name : {"munged", "slurmctld", "slurmd", "sbatch", "squeue", "scancel"}) {
      if (place_of(name).empty()) return name;
    }
    return {};
  }

  SlurmCluster() {
    for (const char* folder : {"state", "spool"}) {
      std::filesystem::create_directory(at(folder));
    }
    write_key();
    std::ofstream(conf()) << configuration();
    // Slurm looks for control groups by default and fails without /sys; they are not used here.
    std::ofstream(at("cgroup.conf")) << "CgroupPlugin=cgroup/v1\n";
    munged_.emplace(
        std::vector<std::string>{place_of("munged"), "--foreground", "--force",
                                 "--key-file=" + at("munge.key"), "--socket=" + at("munge.socket"),
                                 "--pid-file=" + at("munged.pid"),
                                 "--seed-file=" + at("munged.seed"),
                                 "--log-file=" + at("munged.log"), "--num-threads=2"},
        at("munged.out"));
    wait_until("munge's socket", [&] { return std::filesystem::exists(at("munge.socket")); });
    controller_.emplace(std::vector<std::string>{place_of("slurmctld"), "-D", "-f", conf()},
                        at("slurmctld.out"));
    node_.emplace(
        std::vector<std::string>{place_of("slurmd"), "-D", "-f", conf(), "-N", host_name()},
        at("slurmd.out"));
    wait_until("an idle node",
               [&] { return command("sinfo -h -o %t").find("idle") != std::string::npos; });
  }

  // The environment in which programs find the cluster.
  Surroundings surroundings() const {
    Surroundings s;
    s.environment.emplace_back("SLURM_CONF", conf());
    return s;
  }
  // Standard output of a command of Slurm.
  std::string command(const std::string& line) const {
    const std::string whole = "SLURM_CONF=" + conf() + " " + line + " 2>" + at("command.err");
    std::FILE* pipe = popen(whole.c_str(), "r");
    std::string text;
    char block[256];
    while (std::fgets(block, sizeof block, pipe) != nullptr) text += block;
    pclose(pipe);
    return text;
  }
  void wait_for_all_jobs() const {
    wait_until("the end of all jobs", [&] { return command("squeue -h").empty(); });
  }
  // This limit is long enough for the slowest machine; it only ends a command that hangs.
  template <class Condition>
  void wait_until(const std::string& what, Condition condition) const {
    using namespace std::chrono_literals;
    const auto end = std::chrono::steady_clock::now() + 3min;
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end) throw std::runtime_error("no " + what + logs());
      std::this_thread::sleep_for(20ms);
    }
  }

 private:
  static std::string place_of(const std::string& name) {
    for (const char* folder : {"/usr/bin/", "/usr/sbin/", "/usr/local/bin/", "/usr/local/sbin/"}) {
      if (access((folder + name).c_str(), X_OK) == 0) return folder + name;
    }
    return {};
  }
  static std::string host_name() {
    char name[256] = "";
    gethostname(name, sizeof name - 1);
    return std::string(name).substr(0, std::string(name).find('.'));
  }
  static std::string user_name() { return getpwuid(geteuid())->pw_name; }

  // The number of a port that is free now.
  static std::string free_port() {
    const int socket_ = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* general = reinterpret_cast<sockaddr*>(&address);
    if (bind(socket_, general, size) != 0 || getsockname(socket_, general, &size) != 0) {
      throw std::runtime_error("no free port on the loopback address");
    }
    close(socket_);
    return std::to_string(ntohs(address.sin_port));
  }

  std::string at(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string conf() const { return at("slurm.conf"); }

  void write_key() const {
    std::ofstream key(at("munge.key"), std::ios::binary);
    std::random_device random;
    for (int i = 0; i < 256; ++i) key.put(static_cast<char>(random()));
    key.close();
    chmod(at("munge.key").c_str(), 0400);
  }

  std::string configuration() const {
    const std::string host = host_name();
    std::string text = "ClusterName=rotorub\nSlurmctldHost=" + host + "(127.0.0.1)\n";
    for (const auto& [key, value] : std::vector<std::pair<std::string, std::string>>{
             {"SlurmctldPort", free_port()},
             {"SlurmdPort", free_port()},
             {"SlurmUser", user_name()},
             {"SlurmdUser", user_name()},
             {"AuthType", "auth/munge"},
             {"AuthInfo", "socket=" + at("munge.socket")},
             {"CredType", "cred/munge"},
             {"StateSaveLocation", at("state")},
             {"SlurmdSpoolDir", at("spool")},
             {"SlurmctldPidFile", at("slurmctld.pid")},
             {"SlurmdPidFile", at("slurmd.pid")},
             {"SlurmctldLogFile", at("slurmctld.log")},
             {"SlurmdLogFile", at("slurmd.log")},
             {"ProctrackType", "proctrack/linuxproc"},
             {"TaskPlugin", "task/none"},
             {"SelectType", "select/cons_tres"},
             {"SelectTypeParameters", "CR_Core"},
             {"AccountingStorageType", "accounting_storage/none"},
             {"JobAcctGatherType", "jobacct_gather/none"},
             {"JobCompType", "jobcomp/none"},
             {"MpiDefault", "none"},
             {"ReturnToService", "2"},
             {"SlurmdParameters", "config_overrides"},
             {"SchedulerParameters", "batch_sched_delay=1,sched_interval=1"}}) {
      text += key + "=" + value + "\n";
    }
    // The node has two processors, whatever the machine has.
    text += "NodeName=" + host + " NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN\n";
    return text + "PartitionName=all Nodes=" + host + " Default=YES State=UP\n";
  }

  std::string logs() const {
    std::string text;
    for (const char* name : {"munged.out", "slurmctld.log", "slurmd.log", "command.err"}) {
      if (!std::filesystem::exists(at(name))) continue;
      const std::string all = read_text(at(name));
      text += "\n" + std::string(name) + ":\n" +
              all.substr(all.size() - std::min<std::size_t>(all.size(), 2000));
    }
    return text;
  }

  Folder folder_;
  std::optional<Daemon> munged_, controller_, node_;
};

}  // namespace rotorub::test
