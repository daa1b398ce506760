#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "amble/controllers/lane_rows.hpp"
#include "amble/controllers/mixed.hpp"
#include "amble/controllers/modulated_supg_batch.hpp"
#include "amble/controllers/sum_table.hpp"
#include "amble/controllers/supg_kernel.hpp"

namespace amble::controllers {

/// Mixed controllers stepping together; what they do is documented at MixedArchitecture. Sums are fused
/// multiply-adds in the order of the layout's links, from +0 or the bias; all else is rounded operation by
/// operation. The state worth recording: timers and triggers, then the neurons' values.
class MixedBatch : public ModulatedSupgBatch {
 public:
  MixedBatch(ModulatedSupgs supgs, std::shared_ptr<const MixedNet> net, std::vector<std::string> neuron_names,
             MixedParameters parked, int lanes);

  void load(int lane, const Parameters& parameters) override;
  std::vector<std::string> state_names() const override;
  void state(int lane, std::span<float> values) const override;

 private:
  void begin_tick(const robot::SensorFrame& sensors) override;
  void set_rates() override;
  void reshape(float* targets_rad) override;
  void targets_are_set(const LaneArray& targets_rad) override;

  void fill_tables();
  /// A row of sums and its links.
  using Row = std::pair<int, const std::vector<MixedNet::Link>*>;
  void fill(SumTable& table, const std::vector<Row>& rows);
  void fill_phases();
  void read(const robot::SensorFrame& sensors);
  void read_phases();
  bool couples() const { return !net_->couplings.empty(); }

  std::shared_ptr<const MixedNet> net_;
  std::vector<std::string> neuron_names_;
  LaneRows weights_;                                       ///< link by link of the layout
  LaneRows in_phase_, out_of_phase_, minus_out_of_phase_;  ///< coupling by coupling
  std::vector<int> expressed_;                             ///< link by link: in how many lanes
  bool tables_known_ = false;
  SumTable to_neurons_, to_supgs_, to_phases_;
  std::vector<SensedRow> read_;  ///< into the next
  LaneRows values_;              ///< what is summed, row by row (MixedNet)
  LaneRows bias_, step_, next_;  ///< neuron by neuron
  LaneRows sums_;                ///< rates, leg by leg; amplitudes and shifts, SUPG by SUPG
  LaneRows phases_;              ///< leg by leg: the sine, and then leg by leg the cosine
  LaneRows pulls_;               ///< the same of the pulls of other legs
  int legs_, supgs_count_;
};

}  // namespace amble::controllers
