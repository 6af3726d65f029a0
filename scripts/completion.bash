# Completion of titin and scripts/run in bash and zsh; written by scripts/reference.py, do not edit. Put into ~/.bashrc or ~/.zshrc:
#
#   source <this file>
#
# A key comes one part at a time; where the name is yours (materials.NAME), those of the scene on the line are offered.
if [ -n "${ZSH_VERSION:-}" ]; then autoload -U +X compinit bashcompinit && compinit && bashcompinit; fi

_titin_commands='run check advise inspect materials keys help'
_titin_options_run='-h --help -o --overwrite --restart -v -q'
_titin_options_check='-h --help'
_titin_options_advise='-h --help --quantity --tolerance --apply'
_titin_options_inspect='-h --help'
_titin_options_materials='-h --help --json'
_titin_options_keys='-h --help --json'
_titin_options_help='-h --help'
_titin_laws='active_stress arruda_boyce blemker_active blemker_passive blemker_shear cann cann_fibre collagen_table compressible_neo_hookean demiray fung gent goh guccione hencky hill_active hill_passive holmes_mow holzapfel_ogden icnn isotropic_family linear_fibre log mie_gruneisen mooney_rivlin neo_hookean ogden perfect_gas quad quad_log simo st_venant_kirchhoff stiffened_gas veronda_westmann weiss_fibre yeoh'
_titin_keys='averages.<NAME>.lower
averages.<NAME>.upper
body.acceleration
body.scale
boundary.<NAME>.clamp
boundary.<NAME>.damper
boundary.<NAME>.displacement.x
boundary.<NAME>.displacement.y
boundary.<NAME>.displacement.z
boundary.<NAME>.exact
boundary.<NAME>.force
boundary.<NAME>.mass
boundary.<NAME>.normal_velocity
boundary.<NAME>.obstacle.contact
boundary.<NAME>.obstacle.normal
boundary.<NAME>.obstacle.point
boundary.<NAME>.on
boundary.<NAME>.pressure
boundary.<NAME>.rail.along
boundary.<NAME>.rail.force
boundary.<NAME>.rail.mass
boundary.<NAME>.spring
boundary.<NAME>.traction
boundary.<NAME>.traction_scale
boundary.<NAME>.velocity.x
boundary.<NAME>.velocity.y
boundary.<NAME>.velocity.z
boundary.<NAME>.wall
boundary.<NAME>.wall.gap_tolerance
boundary.<NAME>.wall.normal
boundary.<NAME>.wall.penalty
boundary.<NAME>.wall.point
boundary.<NAME>.wall.travel
exact.explosion.end
exact.explosion.gamma
exact.explosion.inside.density
exact.explosion.inside.pressure
exact.explosion.outside.density
exact.explosion.outside.pressure
exact.explosion.radius
exact.explosion.shells
exact.hugoniot.density
exact.hugoniot.slope
exact.hugoniot.sound_speed
exact.hugoniot.speed
exact.kidder.entropy
exact.kidder.inner_density
exact.kidder.inner_radius
exact.kidder.outer_density
exact.kidder.outer_radius
exact.noh.density
exact.noh.gamma
exact.noh.pressure
exact.noh.speed
exact.piston.density
exact.piston.gamma
exact.piston.length
exact.piston.pressure
exact.piston.speed
exact.riemann.gamma
exact.riemann.left.covolume
exact.riemann.left.density
exact.riemann.left.gamma
exact.riemann.left.pressure
exact.riemann.left.stiffening
exact.riemann.left.velocity
exact.riemann.position
exact.riemann.right.covolume
exact.riemann.right.density
exact.riemann.right.gamma
exact.riemann.right.pressure
exact.riemann.right.stiffening
exact.riemann.right.velocity
exact.sedov.density
exact.sedov.energy
exact.sedov.gamma
exact.sedov.pressure
exact.simple_wave.amplitude
exact.simple_wave.centre
exact.simple_wave.density
exact.simple_wave.gamma
exact.simple_wave.pressure
exact.simple_wave.width
exact.solution
exact_motion.blake.pressure
exact_motion.blake.radius
exact_motion.bulk_modulus
exact_motion.density
exact_motion.shear_modulus
exact_motion.solution
exact_motion.swing.amplitude
exact_motion.swing.length
fidelity
fidelity_quantity
fidelity_tolerance
fv.cascade
fv.cfl
fv.collapse
fv.first_step
fv.growth
fv.heat_tolerance
fv.impedance
fv.limiter
fv.order
fv.patch_pressure
fv.predictor
fv.principle_tolerance
fv.range_tolerance
fv.rest
fv.shock_impedance
fv.shock_jump
fv.small_jump
fv.smooth_jump
fv.volume_change
initial.<NAME>.centre
initial.<NAME>.density
initial.<NAME>.energy
initial.<NAME>.length
initial.<NAME>.lower
initial.<NAME>.motion
initial.<NAME>.point
initial.<NAME>.pressure
initial.<NAME>.radius
initial.<NAME>.rate
initial.<NAME>.regions
initial.<NAME>.upper
initial.<NAME>.velocity
initial.centre
initial.length
initial.motion
initial.rate
initial.spin
initial.velocity
link.<NAME>.between
link.<NAME>.damper
link.<NAME>.spring
markers.<NAME>
materials.<NAME>.density
materials.<NAME>.fibre
materials.<NAME>.fibre_invariants
materials.<NAME>.fluid.bond_energy
materials.<NAME>.fluid.covolume
materials.<NAME>.fluid.gamma
materials.<NAME>.fluid.gruneisen
materials.<NAME>.fluid.law
materials.<NAME>.fluid.reference_density
materials.<NAME>.fluid.slope
materials.<NAME>.fluid.sound_speed
materials.<NAME>.fluid.stiffening
materials.<NAME>.growth.direction
materials.<NAME>.growth.law
materials.<NAME>.growth.normal
materials.<NAME>.growth.per
materials.<NAME>.growth.stretch
materials.<NAME>.mix.density
materials.<NAME>.mix.fraction
materials.<NAME>.mix.terms.<NAME>.a
materials.<NAME>.mix.terms.<NAME>.across
materials.<NAME>.mix.terms.<NAME>.activation
materials.<NAME>.mix.terms.<NAME>.af
materials.<NAME>.mix.terms.<NAME>.afs
materials.<NAME>.mix.terms.<NAME>.along
materials.<NAME>.mix.terms.<NAME>.alpha
materials.<NAME>.mix.terms.<NAME>.amplitude
materials.<NAME>.mix.terms.<NAME>.as
materials.<NAME>.mix.terms.<NAME>.b
materials.<NAME>.mix.terms.<NAME>.beta
materials.<NAME>.mix.terms.<NAME>.bf
materials.<NAME>.mix.terms.<NAME>.bff
materials.<NAME>.mix.terms.<NAME>.bffss
materials.<NAME>.mix.terms.<NAME>.bfn
materials.<NAME>.mix.terms.<NAME>.bfs
materials.<NAME>.mix.terms.<NAME>.bias
materials.<NAME>.mix.terms.<NAME>.bnn
materials.<NAME>.mix.terms.<NAME>.bnnff
materials.<NAME>.mix.terms.<NAME>.bs
materials.<NAME>.mix.terms.<NAME>.bsn
materials.<NAME>.mix.terms.<NAME>.bss
materials.<NAME>.mix.terms.<NAME>.bssnn
materials.<NAME>.mix.terms.<NAME>.bt
materials.<NAME>.mix.terms.<NAME>.c
materials.<NAME>.mix.terms.<NAME>.c1
materials.<NAME>.mix.terms.<NAME>.c2
materials.<NAME>.mix.terms.<NAME>.c3
materials.<NAME>.mix.terms.<NAME>.c4
materials.<NAME>.mix.terms.<NAME>.c5
materials.<NAME>.mix.terms.<NAME>.curve
materials.<NAME>.mix.terms.<NAME>.damage.failure
materials.<NAME>.mix.terms.<NAME>.damage.law
materials.<NAME>.mix.terms.<NAME>.damage.most
materials.<NAME>.mix.terms.<NAME>.damage.residual
materials.<NAME>.mix.terms.<NAME>.damage.scale
materials.<NAME>.mix.terms.<NAME>.damage.shape
materials.<NAME>.mix.terms.<NAME>.damage.threshold
materials.<NAME>.mix.terms.<NAME>.damage.time
materials.<NAME>.mix.terms.<NAME>.dynamics.activation_time
materials.<NAME>.mix.terms.<NAME>.dynamics.deactivation_time
materials.<NAME>.mix.terms.<NAME>.dynamics.law
materials.<NAME>.mix.terms.<NAME>.dynamics.start
materials.<NAME>.mix.terms.<NAME>.excitation
materials.<NAME>.mix.terms.<NAME>.exponents_1
materials.<NAME>.mix.terms.<NAME>.exponents_2
materials.<NAME>.mix.terms.<NAME>.family
materials.<NAME>.mix.terms.<NAME>.file
materials.<NAME>.mix.terms.<NAME>.fractional.modulus
materials.<NAME>.mix.terms.<NAME>.fractional.order
materials.<NAME>.mix.terms.<NAME>.fractional.window
materials.<NAME>.mix.terms.<NAME>.g1
materials.<NAME>.mix.terms.<NAME>.g2
materials.<NAME>.mix.terms.<NAME>.k1
materials.<NAME>.mix.terms.<NAME>.k2
materials.<NAME>.mix.terms.<NAME>.kappa
materials.<NAME>.mix.terms.<NAME>.lambda
materials.<NAME>.mix.terms.<NAME>.lambda_straight
materials.<NAME>.mix.terms.<NAME>.law
materials.<NAME>.mix.terms.<NAME>.limit
materials.<NAME>.mix.terms.<NAME>.locking_stretch
materials.<NAME>.mix.terms.<NAME>.log_factors_1
materials.<NAME>.mix.terms.<NAME>.log_factors_2
materials.<NAME>.mix.terms.<NAME>.log_moduli_1
materials.<NAME>.mix.terms.<NAME>.log_moduli_2
materials.<NAME>.mix.terms.<NAME>.max_strain_rate
materials.<NAME>.mix.terms.<NAME>.maxwell.bulk_viscosity
materials.<NAME>.mix.terms.<NAME>.maxwell.viscosity
materials.<NAME>.mix.terms.<NAME>.measure
materials.<NAME>.mix.terms.<NAME>.moduli_1
materials.<NAME>.mix.terms.<NAME>.moduli_2
materials.<NAME>.mix.terms.<NAME>.mu
materials.<NAME>.mix.terms.<NAME>.normalisation
materials.<NAME>.mix.terms.<NAME>.optimal_stretch
materials.<NAME>.mix.terms.<NAME>.p1
materials.<NAME>.mix.terms.<NAME>.p2
materials.<NAME>.mix.terms.<NAME>.peak_stress
materials.<NAME>.mix.terms.<NAME>.projection
materials.<NAME>.mix.terms.<NAME>.prony.reference
materials.<NAME>.mix.terms.<NAME>.prony.strength
materials.<NAME>.mix.terms.<NAME>.prony.time
materials.<NAME>.mix.terms.<NAME>.spectrum.c
materials.<NAME>.mix.terms.<NAME>.spectrum.longest
materials.<NAME>.mix.terms.<NAME>.spectrum.reference
materials.<NAME>.mix.terms.<NAME>.spectrum.shortest
materials.<NAME>.mix.terms.<NAME>.stiffness
materials.<NAME>.mix.terms.<NAME>.stress
materials.<NAME>.mix.terms.<NAME>.stress_free_rest
materials.<NAME>.mix.terms.<NAME>.stress_scale
materials.<NAME>.mix.terms.<NAME>.switch
materials.<NAME>.mix.terms.<NAME>.switch_width
materials.<NAME>.mix.terms.<NAME>.w1
materials.<NAME>.mix.terms.<NAME>.w2
materials.<NAME>.mix.terms.<NAME>.weight_1
materials.<NAME>.mix.terms.<NAME>.weight_2
materials.<NAME>.mix.volumetric.bulk_modulus
materials.<NAME>.mix.volumetric.law
materials.<NAME>.regions
materials.<NAME>.second_fibre
materials.<NAME>.terms.<NAME>.a
materials.<NAME>.terms.<NAME>.across
materials.<NAME>.terms.<NAME>.activation
materials.<NAME>.terms.<NAME>.af
materials.<NAME>.terms.<NAME>.afs
materials.<NAME>.terms.<NAME>.along
materials.<NAME>.terms.<NAME>.alpha
materials.<NAME>.terms.<NAME>.amplitude
materials.<NAME>.terms.<NAME>.as
materials.<NAME>.terms.<NAME>.b
materials.<NAME>.terms.<NAME>.beta
materials.<NAME>.terms.<NAME>.bf
materials.<NAME>.terms.<NAME>.bff
materials.<NAME>.terms.<NAME>.bffss
materials.<NAME>.terms.<NAME>.bfn
materials.<NAME>.terms.<NAME>.bfs
materials.<NAME>.terms.<NAME>.bias
materials.<NAME>.terms.<NAME>.bnn
materials.<NAME>.terms.<NAME>.bnnff
materials.<NAME>.terms.<NAME>.bs
materials.<NAME>.terms.<NAME>.bsn
materials.<NAME>.terms.<NAME>.bss
materials.<NAME>.terms.<NAME>.bssnn
materials.<NAME>.terms.<NAME>.bt
materials.<NAME>.terms.<NAME>.c
materials.<NAME>.terms.<NAME>.c1
materials.<NAME>.terms.<NAME>.c2
materials.<NAME>.terms.<NAME>.c3
materials.<NAME>.terms.<NAME>.c4
materials.<NAME>.terms.<NAME>.c5
materials.<NAME>.terms.<NAME>.curve
materials.<NAME>.terms.<NAME>.damage.failure
materials.<NAME>.terms.<NAME>.damage.law
materials.<NAME>.terms.<NAME>.damage.most
materials.<NAME>.terms.<NAME>.damage.residual
materials.<NAME>.terms.<NAME>.damage.scale
materials.<NAME>.terms.<NAME>.damage.shape
materials.<NAME>.terms.<NAME>.damage.threshold
materials.<NAME>.terms.<NAME>.damage.time
materials.<NAME>.terms.<NAME>.dynamics.activation_time
materials.<NAME>.terms.<NAME>.dynamics.deactivation_time
materials.<NAME>.terms.<NAME>.dynamics.law
materials.<NAME>.terms.<NAME>.dynamics.start
materials.<NAME>.terms.<NAME>.excitation
materials.<NAME>.terms.<NAME>.exponents_1
materials.<NAME>.terms.<NAME>.exponents_2
materials.<NAME>.terms.<NAME>.family
materials.<NAME>.terms.<NAME>.file
materials.<NAME>.terms.<NAME>.fractional.modulus
materials.<NAME>.terms.<NAME>.fractional.order
materials.<NAME>.terms.<NAME>.fractional.window
materials.<NAME>.terms.<NAME>.g1
materials.<NAME>.terms.<NAME>.g2
materials.<NAME>.terms.<NAME>.k1
materials.<NAME>.terms.<NAME>.k2
materials.<NAME>.terms.<NAME>.kappa
materials.<NAME>.terms.<NAME>.lambda
materials.<NAME>.terms.<NAME>.lambda_straight
materials.<NAME>.terms.<NAME>.law
materials.<NAME>.terms.<NAME>.limit
materials.<NAME>.terms.<NAME>.locking_stretch
materials.<NAME>.terms.<NAME>.log_factors_1
materials.<NAME>.terms.<NAME>.log_factors_2
materials.<NAME>.terms.<NAME>.log_moduli_1
materials.<NAME>.terms.<NAME>.log_moduli_2
materials.<NAME>.terms.<NAME>.max_strain_rate
materials.<NAME>.terms.<NAME>.maxwell.bulk_viscosity
materials.<NAME>.terms.<NAME>.maxwell.viscosity
materials.<NAME>.terms.<NAME>.measure
materials.<NAME>.terms.<NAME>.moduli_1
materials.<NAME>.terms.<NAME>.moduli_2
materials.<NAME>.terms.<NAME>.mu
materials.<NAME>.terms.<NAME>.normalisation
materials.<NAME>.terms.<NAME>.optimal_stretch
materials.<NAME>.terms.<NAME>.p1
materials.<NAME>.terms.<NAME>.p2
materials.<NAME>.terms.<NAME>.peak_stress
materials.<NAME>.terms.<NAME>.projection
materials.<NAME>.terms.<NAME>.prony.reference
materials.<NAME>.terms.<NAME>.prony.strength
materials.<NAME>.terms.<NAME>.prony.time
materials.<NAME>.terms.<NAME>.spectrum.c
materials.<NAME>.terms.<NAME>.spectrum.longest
materials.<NAME>.terms.<NAME>.spectrum.reference
materials.<NAME>.terms.<NAME>.spectrum.shortest
materials.<NAME>.terms.<NAME>.stiffness
materials.<NAME>.terms.<NAME>.stress
materials.<NAME>.terms.<NAME>.stress_free_rest
materials.<NAME>.terms.<NAME>.stress_scale
materials.<NAME>.terms.<NAME>.switch
materials.<NAME>.terms.<NAME>.switch_width
materials.<NAME>.terms.<NAME>.w1
materials.<NAME>.terms.<NAME>.w2
materials.<NAME>.terms.<NAME>.weight_1
materials.<NAME>.terms.<NAME>.weight_2
materials.<NAME>.volumetric.bulk_modulus
materials.<NAME>.volumetric.law
mesh.box
mesh.cells
mesh.cuts
mesh.file
mesh.interfaces
mesh.kind
mesh.refine
mesh.shape.bend
mesh.shape.inner_radius
mesh.shape.origin
mesh.shape.ripple
mesh.shape.ripple_at
mesh.shape.skew
mesh.thickness
mesh.unit
model
muscle.element
muscle.ellipticity
muscle.error_estimate
muscle.fibre_rate
muscle.inertia
muscle.order
muscle.pennation_axis
muscle.quadrature
output.checkpoint_every
output.checkpoint_interval
output.checkpoint_keep
output.every
output.fields
output.format
output.history_every
output.history_hdf5
output.interval
output.jumps
output.precision
output.times
output.wall_limit
petsc.<NAME>
reference.columns
reference.history
rod.area
rod.cells
rod.inertia
rod.kind
rod.length
rod.masses
rod.order
rod.pennation
rod.scale
rod.spacing
rod.stability
rod.start.displacement
rod.start.mode
rod.start.stretch
rod.start.velocity
rod.tendon.area
rod.tendon.length
solver.energy_tolerance
solver.globalisation
solver.increment_tolerance
solver.inexact
solver.linear
solver.linear_tolerance
solver.max_iterations
solver.reuse_limit
solver.tolerance
time.alpha
time.end
time.largest_step
time.max_cuts
time.scheme
time.spectral_radius
time.step
time.tolerance
time.velocity
title
torques.<NAME>'
_titin_choices='boundary.<NAME>.clamp true false
boundary.<NAME>.exact none pressure velocity
boundary.<NAME>.obstacle.contact slip stick
boundary.<NAME>.rail.along x y z
boundary.<NAME>.wall true false
exact.solution none kidder riemann noh sedov explosion piston hugoniot simple_wave
exact_motion.solution none swing blake
fidelity as_written auto
fv.cascade limited constant
fv.limiter mood barth_jespersen none
fv.patch_pressure true false
fv.predictor hancock ader rk2
initial.<NAME>.motion uniform radial twist swing bend
initial.motion uniform radial twist swing bend
materials.<NAME>.fibre_invariants isochoric full
materials.<NAME>.fluid.law perfect_gas stiffened_gas mie_gruneisen
materials.<NAME>.growth.law isotropic area fibre
materials.<NAME>.growth.per intermediate reference
materials.<NAME>.mix.terms.<NAME>.damage.law exponential balzani simo_ju
materials.<NAME>.mix.terms.<NAME>.family first second
materials.<NAME>.mix.terms.<NAME>.law active_stress arruda_boyce blemker_passive blemker_active blemker_shear cann cann_fibre collagen_table compressible_neo_hookean demiray fung gent goh guccione hencky hill_active hill_passive holmes_mow holzapfel_ogden icnn isotropic_family linear_fibre mooney_rivlin neo_hookean ogden st_venant_kirchhoff veronda_westmann weiss_fibre yeoh
materials.<NAME>.mix.terms.<NAME>.prony.reference long_term instantaneous
materials.<NAME>.mix.terms.<NAME>.spectrum.reference long_term instantaneous
materials.<NAME>.mix.volumetric.law simo quad log quad_log
materials.<NAME>.terms.<NAME>.damage.law exponential balzani simo_ju
materials.<NAME>.terms.<NAME>.family first second
materials.<NAME>.terms.<NAME>.law active_stress arruda_boyce blemker_passive blemker_active blemker_shear cann cann_fibre collagen_table compressible_neo_hookean demiray fung gent goh guccione hencky hill_active hill_passive holmes_mow holzapfel_ogden icnn isotropic_family linear_fibre mooney_rivlin neo_hookean ogden st_venant_kirchhoff veronda_westmann weiss_fibre yeoh
materials.<NAME>.terms.<NAME>.prony.reference long_term instantaneous
materials.<NAME>.terms.<NAME>.spectrum.reference long_term instantaneous
materials.<NAME>.volumetric.law simo quad log quad_log
mesh.cuts same alternating crossed
mesh.kind tensor simplices wedges
mesh.shape.bend cylinder sphere
model muscle lagrange rod
muscle.element three_field displacement
muscle.ellipticity true false
muscle.error_estimate true false
muscle.fibre_rate stretch_difference velocity_gradient velocity_gradient_symmetric
muscle.inertia dynamic quasi-static
output.fields true false
output.format vtu vtkhdf vtkhdf_transient
output.history_hdf5 true false
output.jumps nodes means kept
output.precision single double
rod.inertia dynamic quasi-static
rod.kind continuum chain massless
rod.spacing centred even
rod.stability true false
solver.globalisation line_search trust_region
solver.inexact true false
solver.linear auto direct block condensed
time.scheme backward_euler semi_implicit newmark hht_alpha generalised_alpha bdf2 energy_momentum
time.velocity rothe lines'

# Names that a scene gives to the tables below $1, such as materials: from its heads, [materials.muscle] or [materials.muscle.terms].
_titin_names() {
  local scene=$1 parent=$2
  [ -n "$scene" ] && [ -f "$scene" ] || return 0
  sed -nE 's/^[[:space:]]*\[([^]]*)\].*/\1/p' "$scene" | tr -d ' ' | while IFS= read -r head; do
    case $head in "$parent".*) head=${head#"$parent".}; case $head in
      \"*) head=${head#\"}; printf '"%s"\n' "${head%%\"*}" ;;
      *) printf '%s\n' "${head%%.*}" ;;
    esac ;; esac
  done | sort -u
}

# The next part of every key that fits what is typed so far: each whole part that is typed against that of the key.
_titin_next() {
  local scene=$1 typed=$2 parent=
  case $typed in *.*) parent=${typed%.*} ;; esac
  printf '%s\n' "$_titin_keys" | TYPED=$typed NAMES=$(_titin_names "$scene" "$parent") awk '
    BEGIN {
      n = split(ENVIRON["TYPED"], typed, "."); if (n == 0) n = 1
      m = split(ENVIRON["NAMES"], names, "\n")
      for (i = 1; i < n; i++) before = before typed[i] "."
    }
    {
      k = split($0, part, "."); if (k < n) next
      for (i = 1; i < n; i++) if (part[i] != "<NAME>" && part[i] != typed[i]) next
      after = k == n ? "=" : "."
      if (part[n] != "<NAME>") print before part[n] after
      else for (j = 1; j <= m; j++) print before names[j] after
    }' | sort -u
}

# The words that a key may take.
_titin_words() {
  local typed=$1 key words pattern
  while read -r key words; do
    pattern=${key//<NAME>/*}
    case $typed in $pattern) printf '%s\n' $words ;; esac
  done <<<"$_titin_choices"
}

_titin_fill() {   # candidates on standard input that begin with $1
  local line
  COMPREPLY=()
  while IFS= read -r line; do
    case $line in "$1"*) COMPREPLY+=("$line") ;; esac
  done
  case ${COMPREPLY[*]} in *[.=]*) compopt -o nospace 2>/dev/null ;; esac
}

_titin_scene_words() {   # a scene, then key=value
  local current=$1 scene= word
  for word in "${COMP_WORDS[@]}"; do case $word in *.toml) [ -f "$word" ] && scene=$word ;; esac; done
  if [ "$current" = = ]; then _titin_fill '' < <(_titin_words "${COMP_WORDS[COMP_CWORD-1]}")
  elif [ "${COMP_WORDS[COMP_CWORD-1]}" = = ]; then _titin_fill "$current" < <(_titin_words "${COMP_WORDS[COMP_CWORD-2]}")
  elif [[ $current == *=* ]]; then   # zsh does not part words at the sign
    _titin_fill "$current" < <(_titin_words "${current%%=*}" | sed "s/^/${current%%=*}=/")
  elif [ -z "$scene" ]; then
    compopt -o filenames 2>/dev/null
    COMPREPLY=($(compgen -f -X '!*.toml' -- "$current") $(compgen -d -- "$current"))
  else _titin_fill "$current" < <(_titin_next "$scene" "$current")
  fi
}

_titin_complete() {   # $1: the sub-command, $2: the word at the cursor
  local options=_titin_options_$1
  case ${COMP_WORDS[COMP_CWORD-1]} in
    -o | --restart) compopt -o filenames 2>/dev/null; COMPREPLY=($(compgen -d -- "$2")); return ;;
  esac
  case $2 in -*) COMPREPLY=($(compgen -W "$(eval "echo \"\${$options:-}\"")" -- "$2")); return ;; esac
  case $1 in
    run | check) _titin_scene_words "$2" ;;
    keys) _titin_fill "$2" < <(_titin_next '' "$2" | sed 's/=$//') ;;
    materials) COMPREPLY=($(compgen -W "$_titin_laws" -- "$2")) ;;
    inspect) compopt -o filenames 2>/dev/null; COMPREPLY=($(compgen -d -- "$2")) ;;
  esac
}

_titin() {
  local current=${COMP_WORDS[COMP_CWORD]}
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then COMPREPLY=($(compgen -W "$_titin_commands --help --version" -- "$current"))
  else _titin_complete "${COMP_WORDS[1]}" "$current"
  fi
}
_titin_run() { COMPREPLY=(); _titin_complete run "${COMP_WORDS[COMP_CWORD]}"; }
_titin_space() { if [ -n "${ZSH_VERSION:-}" ]; then echo -o nospace; fi; }   # zsh asks once for all words
complete $(_titin_space) -F _titin titin build/bin/titin ./titin
complete $(_titin_space) -F _titin_run scripts/run ./scripts/run
