/*---------------------------------------------------------------------------*\
    MSDD: multiscale data-driven heat conduction in granular media

    SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "granularSurrogate.H"
#include "extrapolatedCalculatedFvPatchFields.H"

#include <cctype>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- The model file is damaged or the inputs are not finite: nothing to go on with
static void failed(const char* what, const std::exception& error)
{
    FatalErrorInFunction
        << "The surrogate model failed on " << what << ": " << error.what()
        << exit(FatalError);
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::granularSurrogate::granularSurrogate
(
    const granularProperties& properties,
    const label cells
)
:
    properties_(properties),
    model_(load(properties)),
    material_
    (
        msdd::material
        (
            properties.thermalConductivity().value(),
            properties.youngModulus().value(),
            properties.meanRadius().value()
        )
    ),
    conductivityXX_(cells),
    conductivityYY_(cells),
    stressXX_(cells),
    stressYY_(cells),
    queries_(0),
    clamped_(0)
{}


msdd::Surrogate Foam::granularSurrogate::load
(
    const granularProperties& properties
)
{
    const dictionary& dict = properties.surrogateDict();

    try
    {
        msdd::Surrogate model(properties.modelPath());

        const std::string& wanted = properties.modelHash();
        if (!wanted.empty() && wanted != model.hash())
        {
            FatalIOErrorInFunction(dict)
                << "Entry 'hash' is " << properties.modelHash() << " but model "
                << properties.model() << " has the hash "
                << model.hash()
                << exit(FatalIOError);
        }
        return model;
    }
    catch (const std::exception& error)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'model' is " << properties.model()
            << ", allowed: builtin, builtin:paper, or a readable model file: "
            << error.what() << exit(FatalIOError);
        throw;
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

template<class Type>
Foam::autoPtr<Foam::GeometricField<Type, Foam::fvPatchField, Foam::volMesh>>
Foam::granularSurrogate::given(const word& name, const fvMesh& mesh)
{
    typedef GeometricField<Type, fvPatchField, volMesh> fieldType;

    IOobject header
    (
        name, mesh.time().timeName(), mesh,
        IOobject::MUST_READ, IOobject::NO_WRITE, false
    );
    autoPtr<fieldType> field;

    if (header.typeHeaderOk<fieldType>(true))
    {
        field.reset(new fieldType(header, mesh));
    }
    return field;
}


Foam::List<Foam::scalar*> Foam::granularSurrogate::stateColumns
(
    volScalarField& porosity,
    volScalarField& fabricIndex
)
{
    List<scalar*> columns(2 + extraState_.size());

    columns[0] = porosity.primitiveFieldRef().data();
    columns[1] = fabricIndex.primitiveFieldRef().data();
    forAll(extraState_, i)
    {
        columns[2 + i] = extraState_[i].primitiveFieldRef().data();
    }
    return columns;
}


void Foam::granularSurrogate::readState
(
    volScalarField& porosity,
    volScalarField& fabricIndex
)
{
    const fvMesh& mesh = porosity.mesh();
    const label extra = label(model_.stateSize()) - 2;

    PtrList<volScalarField> known(extra);
    label missing = 0;
    extraState_.resize(extra);
    forAll(extraState_, i)
    {
        // reduced_pressure becomes reducedPressure
        word name;
        bool capital = false;
        for (const char c : model_.stateName(2 + i))
        {
            if (c != '_')
            {
                name += capital ? char(std::toupper(c)) : c;
            }
            capital = (c == '_');
        }
        extraState_.set
        (
            i,
            new volScalarField
            (
                IOobject
                (
                    name, mesh.time().timeName(), mesh,
                    IOobject::NO_READ, IOobject::AUTO_WRITE
                ),
                mesh,
                dimensionedScalar(dimless, Zero),
                extrapolatedCalculatedFvPatchScalarField::typeName
            )
        );
        autoPtr<volScalarField> field(given<scalar>(name, mesh));
        if (field.valid())
        {
            known.set(i, field.release());
        }
        else
        {
            ++missing;
        }
    }

    if (missing)
    {
        fillState(porosity, fabricIndex);
    }
    forAll(known, i)
    {
        if (known.set(i))
        {
            extraState_[i].primitiveFieldRef() = known[i].primitiveField();
        }
        extraState_[i].correctBoundaryConditions();
    }
    if (extra)
    {
        Info<< "State of the model beside porosity and fabricIndex:";
        forAll(extraState_, i)
        {
            Info<< ' ' << extraState_[i].name()
                << (known.set(i) ? " (read)" : "");
        }
        Info<< nl << endl;
    }
}


void Foam::granularSurrogate::fillState
(
    volScalarField& porosity,
    volScalarField& fabricIndex
)
{
    const fvMesh& mesh = porosity.mesh();
    const autoPtr<volScalarField> fabricConductivity
    (
        given<scalar>("fabricConductivity", mesh)
    );
    const autoPtr<volSymmTensorField> stress
    (
        given<symmTensor>("stress", mesh)
    );

    msdd_initial initial(msdd::initial(porosity.size()));
    scalarField xx, yy;

    if (fabricConductivity.valid())
    {
        initial.fabric_conductivity =
            fabricConductivity().primitiveField().cdata();
    }
    if (stress.valid())
    {
        // Tension positive becomes compression positive
        xx = -stress().primitiveField().component(symmTensor::XX);
        yy = -stress().primitiveField().component(symmTensor::YY);
        initial.stress_xx = xx.cdata();
        initial.stress_yy = yy.cdata();
    }

    // Porosity and fabric index come back as they are
    const List<scalar*> columns(stateColumns(porosity, fabricIndex));
    initial.porosity = columns[0];
    initial.fabric_index = columns[1];

    try
    {
        model_.initialState(material_, initial, columns.cdata());
    }
    catch (const std::exception& error)
    {
        failed("the initial state", error);
    }
}


void Foam::granularSurrogate::advance
(
    volScalarField& porosity,
    volScalarField& fabricIndex,
    const volScalarField& thermalStrainIncrement,
    const volScalarField& thermalStrain
)
{
    const List<scalar*> columns(stateColumns(porosity, fabricIndex));
    msdd_batch batch(msdd::batch(porosity.size()));

    batch.state = columns.cdata();
    batch.next_state = columns.cdata();
    batch.thermal_strain = thermalStrainIncrement.primitiveField().cdata();
    batch.total_thermal_strain = thermalStrain.primitiveField().cdata();

    batch.conductivity_xx = conductivityXX_.data();
    batch.conductivity_yy = conductivityYY_.data();
    batch.stress_xx = stressXX_.data();
    batch.stress_yy = stressYY_.data();

    try
    {
        model_.advance(material_, batch);
    }
    catch (const std::exception& error)
    {
        failed("the state of the cells", error);
    }

    ++queries_;
    clamped_ += batch.clamped_cells;

    porosity.correctBoundaryConditions();
    fabricIndex.correctBoundaryConditions();
    forAll(extraState_, i)
    {
        extraState_[i].correctBoundaryConditions();
    }
}


void Foam::granularSurrogate::conductivity(volSymmTensorField& K) const
{
    symmTensorField& cells = K.primitiveFieldRef();

    forAll(cells, celli)
    {
        cells[celli].xx() = conductivityXX_[celli];
        cells[celli].yy() = conductivityYY_[celli];
    }
    K.correctBoundaryConditions();
}


void Foam::granularSurrogate::stress(volSymmTensorField& sigma) const
{
    symmTensorField& cells = sigma.primitiveFieldRef();

    forAll(cells, celli)
    {
        // The one place where compression positive becomes tension positive
        cells[celli].xx() = -stressXX_[celli];
        cells[celli].yy() = -stressYY_[celli];
    }
    sigma.correctBoundaryConditions();
}


Foam::tmp<Foam::scalarField> Foam::granularSurrogate::solidFraction
(
    const scalarField& porosity
) const
{
    tmp<scalarField> tfraction(new scalarField(porosity.size()));

    try
    {
        model_.solidFraction
        (
            porosity.size(),
            porosity.cdata(),
            tfraction.ref().data()
        );
    }
    catch (const std::exception& error)
    {
        failed("the initial porosity", error);
    }
    return tfraction;
}


std::string Foam::granularSurrogate::hash() const
{
    return model_.hash();
}


int64_t Foam::granularSurrogate::clampedQueries() const
{
    return returnReduce(clamped_, sumOp<int64_t>());
}


// ************************************************************************* //
